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

/// Whether content is text that begins as an STL file does, in small letters or capitals, behind blank lines or not.
bool isTextStl(std::span<const std::uint8_t> content);

/// The triangles of an STL file, text or binary, three vertices each, with the sRGB colours of facets and of the head;
/// normals are not read. bytes: the content of path. Throws Error{Input}. After: 3D Systems, StereoLithography
/// Interface Specification, 1989; colours of Materialise Magics and of VisCAM.
Scene readStl(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

} // namespace zvo
