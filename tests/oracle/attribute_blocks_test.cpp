// SPDX-License-Identifier: MIT
// Blocks whose words and voxels were computed by hand from docs/file-format.md, attributes of format 3.
#include "oracle/attribute_formats.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo::oracle
{
namespace
{

constexpr std::size_t kVoxels = 16;

struct Rgb
{
    std::uint32_t red;
    std::uint32_t green;
    std::uint32_t blue;
};

/// An octahedral normal in snorm16.
struct Octahedral
{
    int x;
    int y;
};

std::uint32_t codeOf(const Rgb& color)
{
    return color.red | color.green << 8 | color.blue << 16;
}

std::uint32_t codeOf(const Octahedral& normal)
{
    return static_cast<std::uint16_t>(normal.x) | static_cast<std::uint32_t>(static_cast<std::uint16_t>(normal.y))
                                                      << 16;
}

void expectVoxels(const Block& block, const std::array<Rgb, kVoxels>& colors,
                  const std::array<Octahedral, kVoxels>& normals)
{
    for (std::uint32_t voxel = 0; voxel < kVoxels; ++voxel)
    {
        const gpu::Attribute attribute = unpackBlock(block, voxel);
        EXPECT_EQ(attribute.color, codeOf(colors.at(voxel))) << voxel;
        EXPECT_EQ(attribute.normal, codeOf(normals.at(voxel))) << voxel;
    }
}

TEST(AttributeBlocks, AroundZNormalsAreTheCoordinatesThemselves)
{
    // Colours: a = 10 | 20 << 5 | 5 << 11 = 0x2a8a, which is 10 * 255 / 31 = 82.3, 20 * 255 / 63 = 81.0,
    // 5 * 255 / 31 = 41.1; b = 31 | 63 << 5 = 0x07ff, which is 255, 255, 0.
    constexpr Rgb kA = {82, 81, 41};
    constexpr Rgb kAab = {140, 139, 27}; // (2 * 82 + 255) / 3 = 139.7, (2 * 81 + 255) / 3, 2 * 41 / 3 = 27.3
    constexpr Rgb kAbb = {197, 197, 14}; // (82 + 510) / 3 = 197.3, (81 + 510) / 3, 41 / 3 = 13.7
    constexpr Rgb kB = {255, 255, 0};
    // Scales: x from 0 - 63 to 126 - 63: p = 63 (2 i - 7) * 32767 / 441 = (2 i - 7) * 4681, with i the voxel modulo 8.
    // y from 73 - 63 = 10 to 62 - 63 = -1: q = (70 - 11 j) * 32767 / 441, with j = 1, 1, 2, 2, ... 7, 7, 0, 0:
    // 5201.1, 4383.8, 3566.5, 2749.2, 1931.8, 1114.5 (231 / 441), 297.2, -520.1 for j = 0 to 7.
    // Axis 2 only: x is p, y is q, z is r. The normal's code is (p, q), folded back if it was folded.
    expectVoxels({0x07ff2a8a, 0x321b55e4, 0x27d27f00, 0x3333aaaa, 0x3c3ccccc, 0x3fc0f0f0},
                 {kA, kAab, kAbb, kB, kAab, kAab, kAab, kAab, kB, kAbb, kAab, kA, kAbb, kA, kB, kA},
                 {{{-32767, 4384},
                   {-23405, 4384},
                   {-14043, 3566},
                   {-4681, 3566},
                   {4681, 2749},
                   {14043, 2749},
                   {23405, 1932},
                   {32767, 1932},
                   {-32767, 1115},
                   {-23405, 1115},
                   {-14043, 297},
                   {-4681, 297},
                   {4681, -520},
                   {14043, -520},
                   {23405, 5201},
                   {32767, 5201}}});
}

TEST(AttributeBlocks, DiagonalsAreTurnedAndLimitedBeforeTheyAreFolded)
{
    // Colours: a = 31 << 11 = 0xf800, which is 0, 0, 255; b = 31 | 16 << 11 = 0x801f, which is 255, 0, 131.6.
    constexpr Rgb kAab = {85, 0, 214};  // 255 / 3, 0, (510 + 132) / 3
    constexpr Rgb kAbb = {170, 0, 173}; // 510 / 3, 0, (255 + 264) / 3
    constexpr Rgb kB = {255, 0, 132};
    // Scales: x from 84 - 63 = 21 to 21 - 63 = -42: p = (147 - 63 i) * 32767 / 441 = (7 - 3 i) * 1560.3, with i the
    // voxel modulo 8: 10922, 6241, 1560, -3121, -7802, -12483, -17164, -21845. y from -63 to 63: q = (2 j - 7) * 4681,
    // with j = 3 in the first eight voxels, 6 in the others: -4681 and 23405.
    // Axis 0, negative, diagonal: y is p + q, z is p - q, x is -r; the code is (x, y) where z is not negative,
    // otherwise
    // ((32767 - |y|) s(x), (32767 - |x|) s(y)).
    expectVoxels({0x801ff800, 0xaa55ffff, 0xcfc00ad4, 0x00ffaaaa, 0xffffcccc, 0xff00f0f0},
                 {kB, kB, kB, kB, kB, kB, kB, kB, kAab, kAab, kAab, kAab, kAbb, kAbb, kAbb, kAbb},
                 {{
                     {-10923, 6241},   // 6241, 15603, r = 10923
                     {-20285, 1560},   // 1560, 10922, r = 20285
                     {-23405, -3121},  // -3121, 6241, r = 23405
                     {-23405, -7802},  // -7802, 1560, r = 23405
                     {-20284, -15604}, // -12483, -3121, r = 17163; z < 0: 32767 - 12483, 32767 - 17163
                     {-15603, -24966}, // -17164, -7802, r = 7801; z < 0: 32767 - 17164, 32767 - 7801
                     {12483, -31206},  // -21845, -12483, r = -1561, folded: -20284, -10922; z < 0
                     {17164, -21844},  // -26526, -17164, r = -10923, folded: -15603, -6241; z < 0
                     {12483, 20284},   // 34327 is limited, -12483, r = -12483, folded: 20284, 0
                     {17164, 18724},   // 29646, -17164, r = -14043, folded: 15603, -3121; z < 0
                     {21845, 18724},   // 24965, -21845, r = -14043, folded: 10922, -7802; z < 0
                     {26526, 18724},   // 20284, -26526, r = -14043, folded: 6241, -12483; z < 0
                     {31207, 18724},   // 15603, -31207, r = -14043, folded: 1560, -17164; z < 0
                     {32767, 21845},   // 10922, -35888 is limited, r = -10922, folded: 0, -21845; z < 0
                     {32767, 26526},   // 6241, -40569 is limited, r = -6241, folded: 0, -26526; z < 0
                     {32767, 31207},   // 1560, -45250 is limited, r = -1560, folded: 0, -31207; z < 0
                 }});
}

TEST(AttributeBlocks, TheAxesFollowTheNegativePole)
{
    // Scales: x from 0 to 63: p = 4681 i, with i the voxel modulo 8; y from 0 to -63: q = -4681 j, with j = 0 in the
    // first eight voxels, 7 in the others. Axis 1, negative: z is p, x is q, y is -r. From -y to +z; then from -x,
    // where r = 0, to +y, folded: z = 0, x = -(32767 - 4681 i), y = 4681 i.
    std::array<Rgb, kVoxels> black{};
    std::array<Octahedral, kVoxels> normals{};
    for (int i = 0; i < 8; ++i)
    {
        normals.at(static_cast<std::size_t>(i)) = {0, 4681 * i - 32767};
        normals.at(static_cast<std::size_t>(i) + 8) = {4681 * i - 32767, 4681 * i};
    }
    expectVoxels({0, 0xffffffff, 0x500fff3f, 0xff00aaaa, 0xff00cccc, 0xff00f0f0}, black, normals);
}

TEST(AttributeBlocks, WhatFitsExactlyIsPackedAsItIs)
{
    // Black and white, and a last voxel that is repeated for three more: a = 0, b = 0xffff; all normals along +z.
    std::vector<gpu::Attribute> attributes(13);
    std::uint32_t indices = 0;
    for (const std::uint32_t white : {1U, 2U, 7U, 12U})
    {
        attributes.at(white).color = 0xffffff;
        indices |= 3U << (2 * white);
    }
    const Block block = packBlock(attributes);
    EXPECT_EQ(block[0], 0xffff0000U);
    EXPECT_EQ(block[1], indices | 0xfc000000U);
    for (std::uint32_t voxel = 0; voxel < kVoxels; ++voxel)
    {
        EXPECT_EQ(unpackBlock(block, voxel).normal, 0U) << voxel;
    }
}

} // namespace
} // namespace zvo::oracle
