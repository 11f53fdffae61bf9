// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace zvo
{

enum class MeshFormat
{
    Obj, // with the colours and textures of its .mtl file
    Ply, // with vertex colours
    Stl
};

/// The triangles of an OBJ, PLY or STL file, polygons cut into triangles; points and lines are left out. OBJ is read by
/// assimp, whose importers of the other two hang on damaged files. Vertex colours
/// are sRGB in the file, material colours linear. Material files and textures are read from the file's folder and
/// below; a texture that is missing or not an image is left out with a warning. bytes: the content of path. Throws
/// Error{Input}, one line with the path, for a file that is broken or names a material file outside of its folder.
Scene importMesh(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, MeshFormat format);

} // namespace zvo
