// SPDX-License-Identifier: MIT
#include "oracle/texture.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace zvo::oracle
{
namespace
{

using Rgba = std::array<std::uint8_t, 4>;

Image imageOf(std::uint32_t width, std::uint32_t height, const std::vector<Rgba>& texels)
{
    Image image{{}, width, height, {}};
    for (const Rgba& texel : texels)
        image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
    return image;
}

/// A row of greys.
Image grays(const std::vector<std::uint8_t>& row)
{
    std::vector<Rgba> texels;
    for (const std::uint8_t gray : row)
        texels.push_back({gray, gray, gray, 255});
    return imageOf(static_cast<std::uint32_t>(row.size()), 1, texels);
}

/// Red at texel coordinate x (texel i has its centre at i + 0.5) of a row of greys.
std::uint32_t redAt(const MipChain& mips, double x, WrapMode mode)
{
    const auto u = static_cast<std::int64_t>(std::lround(x * 65536 / mips.levels()[0].width));
    return mips.sample(0, u, 0, mode, mode).color[0];
}

TEST(OracleTexture, Mul16IsTheCorrectlyRoundedProduct)
{
    for (std::uint64_t a = 0; a <= 65535; a += a < 300 || a > 65235 ? 1 : 97)
        for (std::uint64_t b = 0; b <= 65535; b += b < 300 || b > 65235 ? 1 : 89)
            ASSERT_EQ(mul16(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)),
                      (2 * a * b + 65535) / (2 * 65535));
}

TEST(OracleTexture, FractionsAreClampedAndRounded)
{
    EXPECT_EQ(fraction16(0.0F), 0U);
    EXPECT_EQ(fraction16(-1.0F), 0U);
    EXPECT_EQ(fraction16(std::numeric_limits<float>::quiet_NaN()), 0U);
    EXPECT_EQ(fraction16(1.0F), 65535U);
    EXPECT_EQ(fraction16(2.0F), 65535U);
    EXPECT_EQ(fraction16(0.25F), 16384U);       // 16383.75
    EXPECT_EQ(fraction16(0.5F), 32768U);        // 32767.5
    EXPECT_EQ(fraction16(0.61036849F), 40000U); // 40000.4990; a product in single precision is 40000.5
}

TEST(OracleTexture, SrgbTablesHaveKnownValuesAndNoTies)
{
    EXPECT_EQ(linear16(0), 0U);
    EXPECT_EQ(linear16(1), 20U);      // 65535 / 255 / 12.92 = 19.89
    EXPECT_EQ(linear16(188), 32957U); // 0.502886
    EXPECT_EQ(linear16(255), 65535U);
    EXPECT_EQ(srgb8(32768), 188U);
    EXPECT_EQ(srgb8(65535), 255U);
    for (int i = 0; i < 256; ++i)
        EXPECT_EQ(srgb8(linear16(static_cast<std::uint8_t>(i))), i);

    // No value is so close to a rounding boundary that another pow() could change it.
    for (int i = 0; i < 256; ++i)
    {
        const double s = i / 255.0;
        const double linear = 65535.0 * (s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        EXPECT_GT(std::fabs(linear - std::floor(linear) - 0.5), 1e-4) << i;
    }
    for (int i = 0; i < 65536; ++i)
    {
        const double linear = i / 65535.0;
        const double s = 255.0 * (linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
        EXPECT_GT(std::fabs(s - std::floor(s) - 0.5), 1e-7) << i;
    }
}

TEST(OracleTexture, CoordinatesAreClampedAndRounded)
{
    EXPECT_EQ(textureCoordinate(1.0F), 65536);
    EXPECT_EQ(textureCoordinate(-0.5F / 65536), 0);
    EXPECT_EQ(textureCoordinate(1.5F / 65536), 2);
    EXPECT_EQ(textureCoordinate(1e30F), 536870912);
    EXPECT_EQ(textureCoordinate(-INFINITY), -536870912);
    EXPECT_EQ(textureCoordinate(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(OracleTexture, TexelCentersGiveTheTexelAndTheirMiddleTheMean)
{
    const MipChain mips(grays({0, 255, 0, 255}));
    for (const WrapMode mode : {WrapMode::Repeat, WrapMode::MirroredRepeat, WrapMode::ClampToEdge})
    {
        EXPECT_EQ(redAt(mips, 0.5, mode), 0U);
        EXPECT_EQ(redAt(mips, 1.5, mode), 65535U);
        EXPECT_EQ(redAt(mips, 1.0, mode), 32768U);
        EXPECT_EQ(redAt(mips, 1.25, mode), 49151U); // 65535 * 3 / 4 = 49151.25
    }
}

TEST(OracleTexture, AlphaIsRoundedHalvesUp)
{
    const MipChain mips(imageOf(2, 1, {{0, 0, 0, 0}, {0, 0, 0, 1}}));
    EXPECT_EQ(mips.sample(0, 32768, 0, WrapMode::Repeat, WrapMode::Repeat).alpha, 129U); // 128.5
}

TEST(OracleTexture, WrapModesDifferOutsideOfTheImage)
{
    const MipChain mips(grays({0, 0, 0, 255}));
    EXPECT_EQ(redAt(mips, 0.0, WrapMode::Repeat), 32768U); // between the last and the first texel
    EXPECT_EQ(redAt(mips, 0.0, WrapMode::MirroredRepeat), 0U);
    EXPECT_EQ(redAt(mips, 0.0, WrapMode::ClampToEdge), 0U);
    EXPECT_EQ(redAt(mips, 4.5, WrapMode::Repeat), 0U);
    EXPECT_EQ(redAt(mips, 4.5, WrapMode::MirroredRepeat), 65535U);
    EXPECT_EQ(redAt(mips, 7.5, WrapMode::MirroredRepeat), 0U);
    EXPECT_EQ(redAt(mips, 7.5, WrapMode::Repeat), 65535U);
    EXPECT_EQ(redAt(mips, -0.5, WrapMode::Repeat), 65535U);
    EXPECT_EQ(redAt(mips, -0.5, WrapMode::MirroredRepeat), 0U);
    EXPECT_EQ(redAt(mips, -3.5, WrapMode::MirroredRepeat), 65535U);
    EXPECT_EQ(redAt(mips, -3.5, WrapMode::ClampToEdge), 0U);
    EXPECT_EQ(redAt(mips, 100.0, WrapMode::ClampToEdge), 65535U);
}

TEST(OracleTexture, RowsRunFromTheTop)
{
    const MipChain mips(imageOf(1, 2, {{10, 20, 30, 40}, {50, 60, 70, 80}}));
    const Texel16 top = mips.sample(0, 0, 16384, WrapMode::Repeat, WrapMode::Repeat);
    EXPECT_EQ(top.color, (std::array<std::uint32_t, 3>{linear16(10), linear16(20), linear16(30)}));
    EXPECT_EQ(top.alpha, 40U * 257);
    const Texel16 middle = mips.sample(0, 0, 32768, WrapMode::Repeat, WrapMode::Repeat);
    EXPECT_EQ(middle.alpha, 60U * 257);
}

TEST(OracleTexture, MipsAreAlphaWeightedMeansInLinearLight)
{
    const MipChain gray(imageOf(2, 2, {{0, 0, 0, 255}, {255, 255, 255, 255}, {255, 255, 255, 255}, {0, 0, 0, 255}}));
    ASSERT_EQ(gray.levels().size(), 2U);
    EXPECT_EQ(gray.levels()[1].rgba, (std::vector<std::uint8_t>{188, 188, 188, 255}));

    const MipChain leaf(imageOf(2, 2, {{0, 100, 0, 255}, {255, 255, 255, 0}, {255, 255, 255, 0}, {0, 100, 0, 254}}));
    EXPECT_EQ(leaf.levels()[1].rgba, (std::vector<std::uint8_t>{0, 100, 0, 127})); // (509 + 2) / 4

    const MipChain clear(imageOf(2, 2, {{0, 0, 0, 0}, {255, 255, 255, 0}, {255, 255, 255, 0}, {0, 0, 0, 0}}));
    EXPECT_EQ(clear.levels()[1].rgba, (std::vector<std::uint8_t>{188, 188, 188, 0}));
}

TEST(OracleTexture, OddSizesRoundDown)
{
    const MipChain mips(grays({0, 0, 255, 255, 80}));
    ASSERT_EQ(mips.levels().size(), 3U);
    EXPECT_EQ(mips.levels()[1].width, 2U);
    EXPECT_EQ(mips.levels()[1].height, 1U);
    EXPECT_EQ(mips.levels()[1].rgba, (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255, 255, 255}));
    EXPECT_EQ(mips.levels()[2].rgba, (std::vector<std::uint8_t>{188, 188, 188, 255}));
}

TEST(OracleTexture, LevelHasTexelsAboutAsLargeAsAVoxel)
{
    const MipChain mips(imageOf(4, 4, std::vector<Rgba>(16)));
    ASSERT_EQ(mips.levels().size(), 3U);
    // One voxel's area; the texture's share as a multiple of a texel's.
    const std::int64_t area = 65536;
    const std::int64_t texel = (std::int64_t{1} << 32) / 16;
    EXPECT_EQ(mips.levelFor(texel, area), 0U);
    EXPECT_EQ(mips.levelFor(2 * texel, area), 0U);
    EXPECT_EQ(mips.levelFor(2 * texel + 1024, area), 1U);
    EXPECT_EQ(mips.levelFor(8 * texel, area), 1U);
    EXPECT_EQ(mips.levelFor(9 * texel, area), 2U);
    EXPECT_EQ(mips.levelFor(1000 * texel, area), 2U);
    EXPECT_EQ(mips.levelFor(0, 0), 0U);
    EXPECT_EQ(mips.levelFor(1, 0), 2U);
}

} // namespace
} // namespace zvo::oracle
