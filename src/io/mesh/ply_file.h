// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/image/image_io.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace zvo
{

/// The vertices and triangles of a PLY file, text or binary of either byte order: positions, normals, sRGB colours of
/// vertices or faces, texture coordinates of vertices or of the corners of faces with the pictures that comments name.
/// Polygons are cut into triangles as polygon_triangulator.h says; in triangle strips, -1 begins a new strip. bytes:
/// the content of path. Memory stays in proportion to its size, whatever counts it announces. Throws Error{Input}.
/// After: Greg Turk, The PLY Polygon File Format, Stanford University, 1994; pictures as MeshLab writes them.
Scene readPly(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, ImageDecoding decoding);

} // namespace zvo
