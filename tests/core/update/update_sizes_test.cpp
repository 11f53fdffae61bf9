// SPDX-License-Identifier: MIT
#include "core/update/update_sizes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

namespace
{

using zvo::OverlayRegion;
using zvo::UpdateCapacities;
using zvo::UpdateSizes;

zvo::gpu::UpdateStatus done(std::uint32_t nodes, std::uint32_t voxels)
{
    zvo::gpu::UpdateStatus status{};
    status.node_count = nodes;
    status.voxel_count = voxels;
    status.touched_count = nodes / 2;
    return status;
}

zvo::gpu::UpdateStatus failed(std::uint32_t bits, std::uint32_t nodes, std::uint32_t voxels)
{
    zvo::gpu::UpdateStatus status = done(nodes, voxels);
    status.failed = bits;
    return status;
}

TEST(UpdateSizes, RoomIsAsMuchAsWasNeededAndALittleMore)
{
    UpdateSizes sizes(false);
    sizes.begin(1000);
    EXPECT_GT(sizes.likelyNodes(), 1000U);
    sizes.learn(done(800, 9000), {}, 4096);
    EXPECT_GT(sizes.likelyNodes(), 800U);
    EXPECT_LT(sizes.likelyNodes(), 1200U);
    EXPECT_GT(sizes.likelyVoxels(), 9000U);
    EXPECT_LT(sizes.likelyVoxels(), 12000U);
}

TEST(UpdateSizes, ObjectsThatComeLaterAreGuessedToo)
{
    UpdateSizes sizes(false);
    sizes.begin(10);
    sizes.learn(done(20, 100), {}, 4096);
    const std::uint64_t nodes = sizes.likelyNodes();
    sizes.begin(10);
    EXPECT_EQ(sizes.likelyNodes(), nodes);
    sizes.begin(10 + 100000);
    EXPECT_GT(sizes.likelyNodes(), 100000U);
    EXPECT_GT(sizes.likelyVoxels(), 100000U);
}

TEST(UpdateSizes, CapacitiesStayWhileTheySuffice)
{
    UpdateSizes sizes(false);
    sizes.begin(1000);
    const UpdateCapacities first = sizes.fitting({});
    EXPECT_GE(first.records, 1000U);
    EXPECT_GE(first.touched, 2000U);
    EXPECT_TRUE(std::has_single_bit(first.touched));
    EXPECT_GE(first.overlay_nodes, sizes.likelyNodes());
    sizes.learn(done(900, 9000), {}, first.touched);
    sizes.begin(first.records);
    EXPECT_EQ(sizes.fitting(first).records, first.records);
    sizes.begin(first.records + 1);
    EXPECT_GT(sizes.fitting(first).records, first.records);
}

// Capacities that are far too large shrink, but not for a dynamic object that comes and goes.
TEST(UpdateSizes, CapacitiesShrinkWhenLittleMovesForLong)
{
    UpdateSizes sizes(false);
    sizes.begin(1 << 20);
    const UpdateCapacities large = sizes.fitting({});
    sizes.learn(done(1 << 20, 1 << 22), {}, large.touched);
    const auto shrinksWithin = [&](int updates)
    {
        for (int i = 0; i < updates; ++i)
        {
            sizes.begin(100);
            const UpdateCapacities now = sizes.fitting(large);
            if (now.records < large.records)
            {
                EXPECT_GE(now.records, 100U);
                EXPECT_LE(now.touched, 1024U);
                EXPECT_GE(now.overlay_nodes, sizes.likelyNodes());
                return true;
            }
            sizes.learn(done(150, 2000), {}, large.touched);
        }
        return false;
    };
    EXPECT_FALSE(shrinksWithin(500));
    EXPECT_TRUE(shrinksWithin(4000));
}

TEST(UpdateSizes, WhatFailedGetsMore)
{
    UpdateSizes sizes(true);
    sizes.begin(50);
    EXPECT_EQ(sizes.likelyNodes(), 1U);
    EXPECT_EQ(sizes.fitting({}).touched, 1U);
    OverlayRegion region;
    region.node_capacity = 1;
    sizes.learn(failed(zvo::gpu::kFailedNodes, 5, 0), region, 1);
    EXPECT_GE(sizes.likelyNodes(), 5U);
    EXPECT_EQ(sizes.likelyVoxels(), 1U);
    region.node_capacity = 1000; // counted below the region's capacity, as a level was not reached
    sizes.learn(failed(zvo::gpu::kFailedNodes, 5, 0), region, 1);
    EXPECT_GE(sizes.likelyNodes(), 2000U);
    sizes.learn(failed(zvo::gpu::kFailedVoxels, 5, 640), region, 1);
    EXPECT_GE(sizes.likelyVoxels(), 640U);
    sizes.learn(failed(zvo::gpu::kFailedTable, 5, 640), region, 8);
    EXPECT_EQ(sizes.fitting({}).touched, 16U);
}

} // namespace
