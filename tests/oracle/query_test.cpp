// SPDX-License-Identifier: MIT
#include "oracle/query.h"

#include "oracle/morton.h"

#include <gtest/gtest.h>

#include <array>

namespace zvo::oracle
{
namespace
{

// Voxels (1, 0, 0) and (3, 2, 0).
VoxelSet twoVoxels()
{
    const std::array codes = {mortonEncode({1, 0, 0}), mortonEncode({3, 2, 0})};
    return VoxelSet(codes);
}

TEST(QueryOracle, APointIsInTheCellAboveItsLowerFaces)
{
    const VoxelSet voxels = twoVoxels();
    EXPECT_EQ(voxels.atPoint({256, 0, 0}), (QueryAnswer{{1, 0, 0}}));
    EXPECT_EQ(voxels.atPoint({511, 255, 255}), (QueryAnswer{{1, 0, 0}}));
    EXPECT_FALSE(voxels.atPoint({512, 0, 0}));
    EXPECT_FALSE(voxels.atPoint({256, -1, 0}));
}

TEST(QueryOracle, ABoxThatTouchesAVoxelIsEmpty)
{
    const VoxelSet voxels = twoVoxels();
    EXPECT_FALSE(voxels.inBox({0, 0, 0}, {256, 256, 256}));
    EXPECT_EQ(voxels.inBox({0, 0, 0}, {257, 256, 256}), (QueryAnswer{{1, 0, 0}}));
    EXPECT_EQ(voxels.inBox({0, 0, 0}, {1024, 1024, 1024}), (QueryAnswer{{1, 0, 0}}));
    EXPECT_FALSE(voxels.inBox({300, 100, 100}, {300, 200, 200})); // without an inside
}

TEST(QueryOracle, DistancesGoToTheCube)
{
    const VoxelSet voxels = twoVoxels();
    EXPECT_EQ(voxels.nearest({253, 260, 10}, 1000), (QueryAnswer{{1, 0, 0}, 3, 3 * 3 + 4 * 4}));
    EXPECT_EQ(voxels.nearest({253, 260, 10}, 5), (QueryAnswer{{1, 0, 0}, 3, 25}));
    EXPECT_FALSE(voxels.nearest({253, 260, 10}, 4));
    EXPECT_EQ(voxels.nearest({512, 256, 256}, 0), (QueryAnswer{{1, 0, 0}, 3, 0}));
    EXPECT_EQ(voxels.nearest({640, 384, 0}, 1000), (QueryAnswer{{1, 0, 0}, 3, 2 * 128 * 128})); // both are as near
}

TEST(QueryOracle, ABoxMeetsWhatItWouldEnter)
{
    const VoxelSet voxels = twoVoxels();
    const glm::ivec3 low(0);
    const glm::ivec3 high(200);
    EXPECT_EQ(voxels.onWay(low, high, {112, 0, 0}), (QueryAnswer{{1, 0, 0}, 0, 56, 112}));
    EXPECT_FALSE(voxels.onWay(low, high, {56, 0, 0})); // touches it at the end
    EXPECT_EQ(voxels.onWay(low, high, {57, 0, 0}), (QueryAnswer{{1, 0, 0}, 0, 56, 57}));
    EXPECT_EQ(voxels.onWay({56, 0, 0}, {256, 200, 200}, {1, 0, 0}), (QueryAnswer{{1, 0, 0}, 0, 0, 1})); // touches it
    EXPECT_FALSE(voxels.onWay({56, 0, 0}, {256, 200, 200}, {0, 0, 500}));                               // slides along
    EXPECT_EQ(voxels.onWay({57, 0, 0}, {257, 200, 200}, {-500, 0, 0}), (QueryAnswer{{1, 0, 0}, 3, 0, 1}));
    EXPECT_EQ(voxels.onWay({57, 0, 0}, {257, 200, 200}, {0, 0, 0}), (QueryAnswer{{1, 0, 0}, 3, 0, 1}));
    // Over a corner that it passes exactly: it never shares a point with the inside.
    EXPECT_FALSE(voxels.onWay({156, 256, 0}, {256, 356, 100}, {-200, -200, 0}));
    EXPECT_FALSE(voxels.onWay({412, 356, 0}, {512, 456, 100}, {100, -99, 0}));
    EXPECT_EQ(voxels.onWay({411, 356, 0}, {511, 456, 100}, {99, -200, 0}), (QueryAnswer{{1, 0, 0}, 1, 100, 200}));
    // Along all axes at the same time: the last axis counts.
    EXPECT_EQ(voxels.onWay({156, 356, 0}, {206, 406, 100}, {100, -200, 0}), (QueryAnswer{{1, 0, 0}, 1, 100, 200}));
}

} // namespace
} // namespace zvo::oracle
