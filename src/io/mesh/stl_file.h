// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace zvo
{

/// Whether content has exactly the size that a binary STL file of its facet count has.
bool isBinaryStl(std::span<const std::uint8_t> content);

/// The triangles of an STL file, text or binary, three vertices each; normals and colours are not read. bytes: the
/// content of path. Throws Error{Input}. assimp's importer hangs on damaged files. After: 3D Systems, StereoLithography
/// Interface Specification, 1989.
Primitive readStl(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

} // namespace zvo
