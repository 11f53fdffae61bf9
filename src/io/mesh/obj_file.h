// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/image/image_io.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace zvo
{

/// The triangles of an OBJ file with the colours and textures of its material files (mtl_files.h), a primitive for each
/// material. Polygons are cut into triangles (polygon_triangulator.h); points, lines and free-form surfaces are left
/// out. Vertex colours are sRGB in the file, material colours linear. Vertices without a colour are white. Material
/// files and textures must lie in the file's folder or below; one that is missing is left out. bytes: the content of
/// path, in UTF-8. Throws Error{Input}, one line with the path, for a file that is broken. After: Wavefront, Advanced
/// Visualizer Manual, appendix B1, Object Files, 1992.
Scene readObj(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, ImageDecoding decoding);

} // namespace zvo
