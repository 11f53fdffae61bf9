// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// A few colours for many. Colours are red | green << 8 | blue << 16, what is above does not count.
struct Palette
{
    std::vector<std::uint32_t> colors; // [1 to capacity] ascending
    std::vector<std::uint8_t> indices; // [2^24] of each colour that was counted
};

/// At most capacity (1 to 256) colours for those of a picture; counts: [2^24] how often each occurs. As they are where
/// there are no more; otherwise boxes of colours are halved at their mean, the one whose colours
/// deviate most first (after P. Heckbert, Color Image Quantization for Frame Buffer Display, 1982, and X. Wu), and each
/// becomes its mean. Depends on the counts alone. No colours give black.
Palette quantize(std::span<const std::uint32_t> counts, std::uint32_t capacity);

inline constexpr std::uint32_t kColorCount = 1U << 24;

} // namespace zvo
