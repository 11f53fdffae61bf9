// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace zvo
{

/// The vertices and triangles of a PLY file, text or binary of either byte order: positions, normals, sRGB colours.
/// Polygons are cut into fans; triangle strips may start anew after a -1. note receives what is left out, one line, or
/// stays empty. bytes: the content of path. Memory stays in proportion to it, whatever counts it announces. Throws
/// Error{Input}. After: Greg Turk, The PLY Polygon File Format, Stanford University, 1994.
Primitive readPly(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, std::string& note);

} // namespace zvo
