// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace zvo
{

/// Why the decoder (stb_image) must not see an encoded image at all; empty: it may. Walks the segments of a JPEG for
/// what the decoder trusts: Huffman tables no longer than the format allows, and no more scans, of which each costs as
/// much as the picture, than an encoder writes. Takes time in proportion to the file.
std::string findImageFault(std::span<const std::uint8_t> encoded);

/// What the size that a PNG or JPEG announces means for its decoding.
struct ImageCost
{
    bool plausible = false;      // so few bytes can hold so many pixels
    std::uint64_t raw_bytes = 0; // what is to be held at least, whatever the pixels become afterwards
};

/// The cost of an image whose header announces width * height pixels, from its first bytes alone.
ImageCost estimateImageCost(std::span<const std::uint8_t> encoded, std::uint32_t width, std::uint32_t height);

} // namespace zvo
