// SPDX-License-Identifier: MIT
#include "oracle/fragments.h"

#include "oracle/morton.h"
#include "oracle/test_scenes.h"

#include <gtest/gtest.h>
#include <mutex>
#include <set>

namespace zvo::oracle
{
namespace
{

using Weights = std::array<std::uint32_t, 3>;

TEST(OracleMorton, InterleavesWithXInBitZero)
{
    EXPECT_EQ(mortonEncode({1, 0, 0}), 1U);
    EXPECT_EQ(mortonEncode({0, 1, 0}), 2U);
    EXPECT_EQ(mortonEncode({0, 0, 1}), 4U);
    EXPECT_EQ(mortonEncode({2, 3, 1}), 0b011'110U);
    EXPECT_EQ(mortonDecode(mortonEncode({4095, 1234, 77})), glm::uvec3(4095, 1234, 77));
}

TEST(OracleFragment, WeightsAtACornerAnEdgeAndTheMiddle)
{
    // A triangle in the plane z = 100, where voxel (0, 0, 0) has its centre at (128, 128).
    const std::int64_t z = 100;
    EXPECT_EQ(fragmentWeights({Vec{128, 128, z}, Vec{600, 128, z}, Vec{128, 600, z}}, {0, 0, 0}),
              (Weights{65536, 0, 0}));
    EXPECT_EQ(fragmentWeights({Vec{0, 0, z}, Vec{256, 256, z}, Vec{0, 600, z}}, {0, 0, 0}), (Weights{32768, 32768, 0}));
    // Halfway between a corner and the middle of the opposite edge: (1/2, 1/4, 1/4).
    const Triangle triangle{Vec{0, 0, z}, Vec{512, 0, z}, Vec{0, 512, z}};
    EXPECT_EQ(fragmentWeights(triangle, {0, 0, 0}), (Weights{32768, 16384, 16384}));
    // With the winding reversed, the weights are the same.
    EXPECT_EQ(fragmentWeights({triangle[0], triangle[2], triangle[1]}, {0, 0, 0}), (Weights{32768, 16384, 16384}));
}

TEST(OracleFragment, WeightsOutsideOfTheTriangleAreClamped)
{
    const Triangle triangle{Vec{64, 0, 0}, Vec{0, 0, 0}, Vec{0, 64, 0}};
    // At the centre (128, 128): E_0 = 128 * 64, E_1 = (64 - 128 - 128) * 64 < 0, E_2 = 128 * 64.
    EXPECT_EQ(fragmentWeights(triangle, {0, 0, 0}), (Weights{32768, 0, 32768}));
}

TEST(OracleFragment, WeightsComeFromTheColumnOfTheMajorAxis)
{
    // A wall at x = 700. Only y and z matter, so all cells of the column have the same weights.
    const Triangle wall{Vec{700, 0, 0}, Vec{700, 512, 0}, Vec{700, 0, 512}};
    EXPECT_EQ(fragmentWeights(wall, {2, 0, 0}), (Weights{32768, 16384, 16384}));
    EXPECT_EQ(fragmentWeights(wall, {0, 0, 0}), (Weights{32768, 16384, 16384}));
}

TEST(OracleFragment, WeightsOfLargeTrianglesAreShiftedBeforeTheDivision)
{
    // |n_w| = 65536, so k = 1; E_0 = 65280, E_1 = 255, E_2 = 1.
    const Triangle triangle{Vec{127, 127, 0}, Vec{384, 383, 0}, Vec{128, 383, 0}};
    EXPECT_EQ(fragmentWeights(triangle, {0, 0, 0}), (Weights{65280, 254, 2}));
}

TEST(OracleFragment, WeightsWithoutAreaAreThirds)
{
    const Vec p{5, 5, 5};
    EXPECT_EQ(fragmentWeights({p, p, p}, {0, 0, 0}), (Weights{21846, 21845, 21845}));
}

TEST(OracleFragment, WeightsAreCloseToRealBarycentrics)
{
    test::Random random(6);
    for (int i = 0; i < 5000; ++i)
    {
        const Triangle triangle = test::pickTriangle(random, -100000, 100000);
        const Vec normal = normalOf(triangle);
        const std::size_t w = majorAxis(normal);
        const std::size_t u = (w + 1) % 3;
        const std::size_t v = (w + 2) % 3;
        const auto x = [&](std::size_t corner) { return static_cast<double>(triangle[corner][u]); };
        const auto y = [&](std::size_t corner) { return static_cast<double>(triangle[corner][v]); };
        const double area = static_cast<double>(normal[w]);
        double b[3];
        bool inside = area != 0;
        for (std::size_t corner = 0; corner < 3; ++corner)
        {
            const std::size_t next = (corner + 1) % 3;
            const std::size_t last = (corner + 2) % 3;
            b[corner] = ((x(next) - 128) * (y(last) - 128) - (x(last) - 128) * (y(next) - 128)) / area;
            inside = inside && b[corner] >= 0;
        }
        if (!inside)
            continue;
        const Weights weights = fragmentWeights(triangle, {0, 0, 0});
        for (std::size_t corner = 0; corner < 3; ++corner)
            ASSERT_NEAR(weights[corner] / 65536.0, b[corner], 1.5e-4) << "case " << i;
    }
}

TEST(OracleDither, RanksAreAPermutation)
{
    std::set<std::uint32_t> ranks;
    for (const glm::uvec3& voxel : test::allVoxels(4))
        ranks.insert(ditherRank(voxel));

    EXPECT_EQ(ranks.size(), 64U);
    EXPECT_EQ(*ranks.begin(), 0U);
    EXPECT_EQ(*ranks.rbegin(), 63U);
    EXPECT_EQ(ditherRank({1, 0, 0}), 0b110'000U);
    EXPECT_EQ(ditherRank({0, 1, 0}), 0b011'000U);
    EXPECT_EQ(ditherRank({0, 0, 1}), 0b001'000U);
    EXPECT_EQ(ditherRank({2, 2, 0}), 0b000'101U);
    EXPECT_EQ(ditherRank({5, 4, 8}), ditherRank({1, 0, 0}));
}

TEST(OracleDither, AlphaIsTheShareOfVoxels)
{
    const Material blend = test::materialOf(AlphaMode::Blend);
    for (const std::uint32_t alpha : {0U, 511U, 512U, 16384U, 32768U, 65023U, 65024U, 65535U})
    {
        std::uint32_t count = 0;
        for (const glm::uvec3& voxel : test::allVoxels(4))
            count += alphaPasses(blend, alpha, voxel) ? 1 : 0;

        EXPECT_EQ(count, (alpha + 512) / 1024) << alpha;
    }
}

TEST(OracleAlpha, MaskComparesWithTheCutoff)
{
    Material mask = test::materialOf(AlphaMode::Mask);
    EXPECT_FALSE(alphaPasses(mask, 32767, {}));
    EXPECT_TRUE(alphaPasses(mask, 32768, {}));
    mask.alpha_cutoff = 0.0F;
    EXPECT_TRUE(alphaPasses(mask, 0, {}));
    mask.alpha_cutoff = 1.0F;
    EXPECT_FALSE(alphaPasses(mask, 65534, {}));
    EXPECT_TRUE(alphaPasses(mask, 65535, {}));
    mask.alpha_cutoff = 1.001F;
    EXPECT_FALSE(alphaPasses(mask, 65535, {}));
    EXPECT_TRUE(alphaPasses(test::materialOf(AlphaMode::Opaque), 0, {}));
}

TEST(OracleFragment, ChunksCoverEachNumberOnce)
{
    for (const std::uint64_t count : {0U, 1U, 1023U, 1024U, 1025U, 10201U})
    {
        std::mutex mutex;
        std::vector<std::uint32_t> seen(count);
        forEachChunk(count,
                     [&](std::uint32_t thread, std::uint64_t first, std::uint64_t last)
                     {
                         const std::lock_guard lock(mutex);
                         EXPECT_LT(thread, threadCount());
                         for (std::uint64_t i = first; i < last; ++i)
                             ++seen.at(i);
                     });
        EXPECT_EQ(seen, std::vector<std::uint32_t>(count, 1));
    }
}

} // namespace
} // namespace zvo::oracle
