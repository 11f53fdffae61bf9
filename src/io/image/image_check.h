// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace zvo
{

/// Says why the decoder (stb_image) must not read an encoded image at all; empty: it may. Reads the segments of a JPEG
/// and checks what the decoder trusts: that Huffman tables are no longer than the format allows, and that there are no
/// more scans than an encoder writes, as each scan costs as much as the picture. Takes time in proportion to the size
/// of the file.
std::string findImageFault(std::span<const std::uint8_t> encoded);

/// The cost of decoding a PNG, JPEG, BMP or TGA, from the size that it announces.
struct ImageCost
{
    bool plausible = false;      // the file is long enough for so many pixels
    std::uint64_t raw_bytes = 0; // bytes that decoding needs at least, whatever the pixels become afterwards
};

/// The cost of an image whose header announces width * height pixels, from its first bytes alone.
ImageCost estimateImageCost(std::span<const std::uint8_t> encoded, std::uint32_t width, std::uint32_t height);

} // namespace zvo
