// SPDX-License-Identifier: MIT
// Coverage with the largest numbers.
#include "core/base/kernels.h"
#include "stress/compare_coverage.h"
#include "support/device.h"
#include "voxelize/voxelize.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

constexpr int kEnd = 1 << 29; // end of the lattice

/// count triangles with coordinates drawn from values, for a grid of this depth.
stress::Batch batchOf(std::uint32_t depth, std::size_t count, const std::vector<int>& values, std::mt19937& random)
{
    stress::Batch batch{stress::Shape::Huge, depth, false, {}};
    for (std::size_t i = 0; i < count; ++i)
    {
        stress::LatticeTriangle triangle{};
        for (glm::ivec3& p : triangle)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                p[axis] = values[random() % values.size()];
            }
        }
        batch.triangles.push_back(triangle);
    }
    return batch;
}

void expectNoDifferences(const stress::Batch& batch, std::uint64_t& fragments)
{
    for (const Coverage coverage : {Coverage::Conservative, Coverage::Thin})
    {
        const stress::Tally tally = stress::compareBatch(test::sharedDevice(zvoKernels()), batch, coverage);
        fragments += tally.fragments;
        EXPECT_EQ(tally.differences, 0U);
        for (const std::string& finding : tally.findings)
        {
            ADD_FAILURE() << finding;
        }
    }
}

TEST(CoverageExtremes, TrianglesBetweenTheEndsOfTheLatticeEqualTheOracle)
{
    std::mt19937 random(1);
    std::uint64_t fragments = 0;
    for (std::uint32_t i = 0; i < 60; ++i)
    {
        const std::uint32_t depth = 1 + i % 6;
        const int middle = 128 << depth;
        // Single precision holds multiples of 32 below 2^29.
        const std::vector<int> values = {-kEnd, -kEnd + 32, middle - 1, middle, middle + 1, kEnd - 32, kEnd};
        expectNoDifferences(batchOf(depth, 40, values, random), fragments);
    }
    EXPECT_GT(fragments, 100000U);
}

TEST(CoverageExtremes, TrianglesFromTheGridToTheEndsOfTheLatticeEqualTheOracle)
{
    std::mt19937 random(2);
    std::uint64_t fragments = 0;
    for (std::uint32_t i = 0; i < 60; ++i)
    {
        const std::uint32_t depth = 1 + i % 6;
        const int edge = 256 << depth;
        std::vector<int> values = {-kEnd, kEnd, 0, edge, edge / 2, 128, edge - 128, -1, edge + 1};
        for (int k = 0; k < 9; ++k)
        {
            values.push_back(static_cast<int>(random() % static_cast<std::uint32_t>(edge)));
        }
        expectNoDifferences(batchOf(depth, 40, values, random), fragments);
    }
    EXPECT_GT(fragments, 100000U);
}

// Up to kTileExtent a tile is 4x4 columns, for which edge functions are cut down to 32 bits; beyond it is one column.
TEST(CoverageExtremes, TrianglesAboutAsLargeAsThe32BitTilesAllowEqualTheOracle)
{
    std::mt19937 random(3);
    std::uint64_t fragments = 0;
    for (std::uint32_t i = 0; i < 72; ++i)
    {
        const std::uint32_t depth = 1 + i % 6;
        const int edge = 256 << depth;
        // Exactly the limit, a step of single precision less, and a step more; from one side of the grid, or both.
        const int size = gpu::kTileExtent + std::array{-4, 0, 8}[i / 6 % 3];
        std::vector<int> values = {0, size, edge / 2, 128, edge};
        if (i % 2 == 1)
        {
            values = {-size / 2, size - size / 2, edge / 2, edge - 128, 0};
        }
        for (int k = 0; k < 4; ++k)
        {
            values.push_back(static_cast<int>(random() % static_cast<std::uint32_t>(edge)));
        }
        expectNoDifferences(batchOf(depth, 40, values, random), fragments);
    }
    EXPECT_GT(fragments, 100000U);
}

} // namespace
} // namespace zvo
