// SPDX-License-Identifier: MIT
#include "core/base/grid.h"

#include "zvo/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace zvo
{

namespace
{

bool encloses(const Grid& grid, const Bounds& bounds)
{
    const glm::dvec3 low(grid.origin);
    const glm::dvec3 high = low + static_cast<double>(grid.voxel_size) * grid.resolution();
    return glm::all(glm::lessThanEqual(low, glm::dvec3(bounds.min))) &&
           glm::all(glm::greaterThanEqual(high, glm::dvec3(bounds.max)));
}

Bounds box(const glm::vec3& min, const glm::vec3& max)
{
    return {.min = min, .max = max};
}

TEST(Grid, AroundIsTheSmallestCubeCenteredOnTheBox)
{
    const Grid grid = Grid::around(box({1, 2, 3}, {5, 4, 4}), 2);
    EXPECT_EQ(grid.depth, 2U);
    EXPECT_EQ(grid.voxel_size, 1.0F);
    EXPECT_EQ(grid.origin, glm::vec3(1.0F, 1.0F, 1.5F));
}

TEST(Grid, AMarginIsFreeAtEachSide)
{
    const Grid grid = Grid::around(box({1, 2, 3}, {5, 4, 4}), 4, 4);
    EXPECT_EQ(grid.voxel_size, 0.5F);
    EXPECT_EQ(grid.origin, glm::vec3(-1.0F, -1.0F, -0.5F));
}

TEST(Grid, WithCornerStartsAtTheMinimum)
{
    const Grid grid = Grid::withCorner(box({1, 2, 3}, {5, 4, 4}), 3);
    EXPECT_EQ(grid.voxel_size, 0.5F);
    EXPECT_EQ(grid.origin, glm::vec3(1.0F, 2.0F, 3.0F));
}

TEST(Grid, EmptyBoxOrPointGivesTheUnitCube)
{
    const Grid empty = Grid::around({}, 1);
    EXPECT_EQ(empty.voxel_size, 0.5F);
    EXPECT_EQ(empty.origin, glm::vec3(-0.5F));
    const Grid point = Grid::around(box(glm::vec3(7), glm::vec3(7)), 1);
    EXPECT_EQ(point.voxel_size, 0.5F);
    EXPECT_EQ(point.origin, glm::vec3(6.5F));
    EXPECT_EQ(Grid::withCorner(box(glm::vec3(7), glm::vec3(7)), 1).voxel_size, 0.5F);
}

TEST(Grid, BoxAtTheEndOfSinglePrecisionHasAFiniteGrid)
{
    constexpr float kMax = std::numeric_limits<float>::max();
    for (const Bounds& bounds : {Bounds{{-kMax, -kMax, 0}, {kMax, 0, 1}}, Bounds{{-kMax, 1, 0}, {kMax, kMax, 1}},
                                 Bounds{glm::vec3(-kMax), glm::vec3(kMax)}, Bounds{glm::vec3(kMax), glm::vec3(kMax)},
                                 Bounds{{0, -kMax, 0}, {kMax, -kMax, 0}}})
    {
        for (const Grid& grid :
             {Grid::around(bounds, 1), Grid::around(bounds, Grid::kDepthMax), Grid::withCorner(bounds, 1)})
        {
            EXPECT_TRUE(std::isfinite(grid.voxel_size)) << grid.voxel_size;
            EXPECT_TRUE(std::isfinite(grid.origin.x) && std::isfinite(grid.origin.y) && std::isfinite(grid.origin.z));
            EXPECT_TRUE(encloses(grid, bounds));
        }
    }
}

TEST(Grid, WithCornerRefusesAnEmptyBox)
{
    try
    {
        Grid::withCorner({}, 4);
        FAIL();
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
    }
}

TEST(Grid, BoxStaysInsideInSpiteOfRounding)
{
    std::mt19937 random(1); // NOLINT: the same boxes on every run
    std::uniform_real_distribution<float> coordinate(-100.0F, 100.0F);
    for (int i = 0; i < 2000; ++i)
    {
        const float far = i % 2 == 0 ? 0.0F : 1e6F;
        const glm::vec3 a(coordinate(random) + far, coordinate(random), coordinate(random));
        const glm::vec3 b(coordinate(random) + far, coordinate(random), coordinate(random));
        const Bounds bounds = box(glm::min(a, b), glm::max(a, b));
        for (const std::uint32_t depth : {1U, 9U, Grid::kDepthMax})
        {
            EXPECT_TRUE(encloses(Grid::around(bounds, depth), bounds));
            EXPECT_TRUE(encloses(Grid::withCorner(bounds, depth), bounds));
        }
    }
}

TEST(Grid, ExtremeBoxesKeepTheLatticeScaleFinite)
{
    const Bounds tiny = box(glm::vec3(0), glm::vec3(1e-44F));
    const Bounds huge = box(glm::vec3(-3e38F), glm::vec3(3e38F));
    for (const Bounds& bounds : {tiny, huge})
    {
        for (const std::uint32_t depth : {1U, Grid::kDepthMax})
        {
            const Grid grid = Grid::around(bounds, depth);
            EXPECT_TRUE(std::isfinite(grid.voxel_size));
            EXPECT_GT(grid.voxel_size, 0.0F);
            EXPECT_TRUE(std::isfinite(256.0F / grid.voxel_size));
            EXPECT_TRUE(encloses(grid, bounds));
        }
    }
}

TEST(Grid, OddDepthHasALevelMoreAtTheRoot)
{
    Grid grid;
    grid.depth = 9;
    EXPECT_EQ(grid.resolution(), 512U);
    EXPECT_EQ(grid.nodeLevels(), 5U);
    EXPECT_EQ(grid.rootResolution(), 1024U);
}

} // namespace

} // namespace zvo
