// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/image/image_io.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace zvo
{

/// The triangles of an OBJ file with the colours and textures of its material files, read by assimp. Polygons are cut
/// into triangles (polygon_triangulator.h); points and lines are left out. Vertex colours are sRGB in the file,
/// material colours linear. Material files and textures must lie in the file's folder or below; a texture that is
/// missing or not an image is left out with a warning. bytes: the content of path. Throws Error{Input}, one line with
/// the path, for a file that is broken or names a material file outside of its folder.
Scene readObj(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, ImageDecoding decoding);

} // namespace zvo
