// SPDX-License-Identifier: MIT
// The parts of a .gltf or .glb file, whose contents are not interpreted yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

namespace zvo
{

struct GltfContainer
{
    std::string_view json;
    std::span<const std::uint8_t> bin; // empty where there is none
};

/// The parts of a file, with references to its bytes. Plain JSON and binary glTF are told apart by their content. path:
/// for messages. Throws Error{Input}.
GltfContainer openGltfContainer(std::span<const std::uint8_t> file, const std::filesystem::path& path);

/// Parses JSON text, unless it is nested too deeply. Throws Error{Input}.
nlohmann::json parseGltfJson(std::string_view text, const std::filesystem::path& path);

} // namespace zvo
