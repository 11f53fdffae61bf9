// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The most pixels along an edge of a picture that is read or written.
inline constexpr std::uint32_t kImageEdgeMax = 16384;

/// Decodes a PNG, JPEG or WebP to 8-bit RGBA; 16-bit channels keep their upper byte, grey and palettes become colours.
/// name: of the resulting Image. where: the beginning of messages. Throws Error{Input}, before anything is decoded for
/// an image of more than bytes_max decoded bytes.
Image decodeImage(std::span<const std::uint8_t> encoded, const std::string& name, const std::string& where,
                  std::uint64_t bytes_max = UINT64_MAX);

/// A PNG file of width * height pixels from rgba, 4 bytes each, rows from the top. Equal pictures give equal bytes.
std::vector<std::uint8_t> encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);

} // namespace zvo
