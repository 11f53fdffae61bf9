// SPDX-License-Identifier: MIT
// Mutations that keep most glTF files readable, so that a fuzzer gets past the parsers.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace zvo::test
{

/// The chunks of a .glb file, or the text of a .gltf file.
struct GltfParts
{
    bool binary = false;
    std::string text;
    std::vector<std::uint8_t> bin;

    /// A file that is no complete .glb becomes text.
    static GltfParts split(std::span<const std::uint8_t> file);

    /// The file, with correct chunk lengths.
    [[nodiscard]] std::vector<std::uint8_t> join() const;
};

/// Changes one value, key or item of the JSON in text. Does not change text that is no JSON, or is deeply nested.
void mutateJson(std::string& text, std::mt19937& random);

/// Overwrites an aligned number in bin with an extreme one.
void mutateBin(std::vector<std::uint8_t>& bin, std::mt19937& random);

/// Copies a member of the JSON of other into text.
void crossJson(std::string& text, const std::string& other, std::mt19937& random);

} // namespace zvo::test
