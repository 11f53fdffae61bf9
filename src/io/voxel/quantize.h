// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// A palette of a few colours that stands for many. Colours are red | green << 8 | blue << 16; higher bits are ignored.
struct Palette
{
    std::vector<std::uint32_t> colors; // [1 to capacity] ascending
    std::vector<std::uint8_t> indices; // [2^24] index in `colors` for each colour that was counted
};

/// Chooses at most capacity (1 to 256) colours for those of a picture. counts: [2^24] how often each colour occurs. If
/// there are no more than capacity colours, they are kept as they are. Otherwise boxes of colours are halved at their
/// mean, the box whose colours deviate most first (after P. Heckbert, Color Image Quantization for Frame Buffer
/// Display, 1982, and X. Wu), and each box becomes its mean. Depends on the counts alone. Without colours the palette
/// is black.
Palette quantize(std::span<const std::uint32_t> counts, std::uint32_t capacity);

inline constexpr std::uint32_t kColorCount = 1U << 24;

} // namespace zvo
