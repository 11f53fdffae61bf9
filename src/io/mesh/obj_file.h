// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/image/image_io.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace zvo
{

/// The triangles of an OBJ file with the colours and textures of its material files, read by assimp as importMesh()
/// describes. bytes: the content of path. Throws Error{Input}.
Scene readObj(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, ImageDecoding decoding);

} // namespace zvo
