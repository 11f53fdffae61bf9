// SPDX-License-Identifier: MIT
#include "io/voxel/quantize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace zvo
{
namespace
{

std::vector<std::uint32_t> countsOf(const std::map<std::uint32_t, std::uint32_t>& colors)
{
    std::vector<std::uint32_t> counts(kColorCount);
    for (const auto& [color, count] : colors)
    {
        counts[color] = count;
    }
    return counts;
}

TEST(Quantize, FewColorsStayAsTheyAre)
{
    std::map<std::uint32_t, std::uint32_t> colors;
    std::mt19937 random(1);
    while (colors.size() < 255)
    {
        colors[static_cast<std::uint32_t>(random()) % kColorCount] = 1 + static_cast<std::uint32_t>(random()) % 9;
    }
    const Palette palette = quantize(countsOf(colors), 255);
    EXPECT_EQ(palette.colors.size(), 255U);
    EXPECT_TRUE(std::is_sorted(palette.colors.begin(), palette.colors.end()));
    for (const auto& [color, count] : colors)
    {
        EXPECT_EQ(palette.colors[palette.indices[color]], color);
    }
}

TEST(Quantize, NoColorsGiveBlack)
{
    EXPECT_EQ(quantize(std::vector<std::uint32_t>(kColorCount), 255).colors, std::vector<std::uint32_t>{0});
}

TEST(Quantize, OneMoreThanThereIsRoomForMergesTheTwoThatAreNearest)
{
    std::map<std::uint32_t, std::uint32_t> colors;
    for (std::uint32_t i = 0; i < 4; ++i)
    {
        colors[0x40U * i] = 1; // red 0, 64, 128, 192
    }
    colors[0xc4U] = 3; // 196
    const Palette palette = quantize(countsOf(colors), 4);
    EXPECT_EQ(palette.colors, (std::vector<std::uint32_t>{0, 0x40, 0x80, 0xc3})); // (192 + 3 * 196) / 4
}

TEST(Quantize, ManyColorsBecomeNearOnes)
{
    std::map<std::uint32_t, std::uint32_t> colors;
    std::mt19937 random(2);
    for (int i = 0; i < 20000; ++i)
    {
        ++colors[static_cast<std::uint32_t>(random()) % kColorCount];
    }
    const Palette palette = quantize(countsOf(colors), 255);
    EXPECT_GE(palette.colors.size(), 250U);
    EXPECT_LE(palette.colors.size(), 255U);
    double squares = 0;
    for (const auto& [color, count] : colors)
    {
        const std::uint32_t found = palette.colors[palette.indices[color]];
        for (const std::uint32_t shift : {0U, 8U, 16U})
        {
            const double distance =
                static_cast<double>(color >> shift & 255U) - static_cast<double>(found >> shift & 255U);
            squares += count * distance * distance;
        }
    }
    // 255 cells of a cube of 256^3 are about 40 wide: a uniform error of 40 / sqrt(12) = 12 for each channel
    EXPECT_LT(std::sqrt(squares / 20000 / 3), 14.0);
    EXPECT_EQ(quantize(countsOf(colors), 255).colors, palette.colors);
}

} // namespace
} // namespace zvo
