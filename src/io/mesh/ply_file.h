// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The vertices and triangles of a PLY file, text or binary of either byte order: positions, normals, sRGB colours.
/// Polygons are cut into triangles as polygon_triangulator.h says; in triangle strips, -1 begins a new strip. notes:
/// receives a line for each kind of part that is left out. bytes: the content of path. Memory stays in proportion to
/// its size, whatever counts it announces. Throws Error{Input}. assimp's importer hangs on damaged files. After: Greg
/// Turk, The PLY Polygon File Format, Stanford University, 1994.
Primitive readPly(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                  std::vector<std::string>& notes);

} // namespace zvo
