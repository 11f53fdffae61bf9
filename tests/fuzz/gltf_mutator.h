// SPDX-License-Identifier: MIT
// Mutations that leave a glTF file readable, so that a fuzzer gets past the parsers.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace zvo::test
{

/// A .glb file taken apart, or a .gltf file, whose text is all of it.
struct GltfParts
{
    bool binary = false;
    std::string text;
    std::vector<std::uint8_t> bin;

    /// What is no whole .glb becomes text.
    static GltfParts split(std::span<const std::uint8_t> file);

    /// The file, with chunk lengths that are right.
    [[nodiscard]] std::vector<std::uint8_t> join() const;
};

/// Changes one value, key or item of the JSON in text. Leaves text alone where it is not JSON or deeply nested.
void mutateJson(std::string& text, std::mt19937& random);

/// Overwrites an aligned number in bin with an extreme one.
void mutateBin(std::vector<std::uint8_t>& bin, std::mt19937& random);

/// Takes a member of the JSON of other over into text.
void crossJson(std::string& text, const std::string& other, std::mt19937& random);

} // namespace zvo::test
