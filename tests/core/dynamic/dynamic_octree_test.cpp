// SPDX-License-Identifier: MIT
// Merging dynamic objects gives the same result as voxelizing everything anew.
#include "core/dynamic/dynamic_octree.h"
#include "support/dynamic_world.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace zvo
{
namespace
{

using test::Cell;
using test::device;
using test::DynamicWorld;
using test::Item;
using Kind = test::Placement::Kind;

Item inside(int x, int y, int z)
{
    return {0, {Kind::Inside, {x, y, z}}};
}

// Checks the functions by which the tests compare trees.
TEST(DynamicOctree, IsMadeOfTheCellsThatItHas)
{
    DynamicWorld world(device(), {.depth = 6});
    const std::vector<Cell> cells = world.shown();
    ASSERT_GT(cells.size(), 1000U);
    const DeviceTree octree = test::octreeOf(device(), cells, world.setting().grid(), 1.0F);
    EXPECT_EQ(test::difference(test::cellsOf(device(), octree), cells), "");
    EXPECT_GT(octree.emission.count(), 0U);
}

TEST(DynamicOctree, ShowsTheStaticOctreeWithoutObjects)
{
    DynamicWorld world(device(), {.depth = 6});
    EXPECT_EQ(world.differenceFromRebuilt({}), "");
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({}), "");
}

TEST(DynamicOctree, FollowsObjectsThatComeMoveAndGo)
{
    DynamicWorld world(device(), {.depth = 6});
    const Item overlapping = {0, {Kind::Turned, {1, 1, 1}}};
    const DynamicObjectId first = world.add(inside(1, 1, 1));
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(1, 1, 1)}), "");
    const DynamicObjectId second = world.add(inside(1, 1, 1));
    world.setPose(second, overlapping);
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(1, 1, 1), overlapping}), "");
    world.setPose(first, inside(2, 2, 2));
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(2, 2, 2), overlapping}), "");
    world.octree().remove(second);
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(2, 2, 2)}), "");
    world.setPose(first, inside(3, 2, 2)); // across the border
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(3, 2, 2)}), "");
    world.setPose(first, {0, {Kind::Outside, {2, 2, 2}}});
    EXPECT_EQ(world.update().dynamic_count, 0U);
    EXPECT_EQ(world.differenceFromRebuilt({}), "");
}

TEST(DynamicOctree, UndoAndRedoShowEarlierEntries)
{
    DynamicWorld world(device(), {.depth = 6});
    const DynamicObjectId object = world.add(inside(0, 0, 0));
    std::vector<std::vector<Cell>> shown = {world.shown()};
    for (int i = 0; i < 4; ++i)
    {
        world.setPose(object, inside(i, 1, 0));
        world.update();
        shown.push_back(world.shown());
        EXPECT_EQ(world.differenceFromRebuilt({inside(i, 1, 0)}), "");
    }
    for (std::size_t i = 4; i-- > 0;)
    {
        EXPECT_TRUE(world.undo());
        EXPECT_EQ(world.differenceFrom(shown[i]), "");
    }
    EXPECT_FALSE(world.undo());
    EXPECT_TRUE(world.redo());
    EXPECT_TRUE(world.redo());
    EXPECT_EQ(world.differenceFrom(shown[2]), "");
    EXPECT_NE(world.add(inside(0, 0, 0)), object);
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(1, 1, 0), inside(0, 0, 0)}), "");
    EXPECT_FALSE(world.redo());
}

TEST(DynamicOctree, SpreadsAnUpdateOverFramesAndShowsTheLastRootMeanwhile)
{
    DynamicWorld world(device(), {.depth = 6});
    const DynamicObjectId object = world.add(inside(1, 1, 1));
    world.update();
    world.setPose(object, inside(2, 0, 1));
    std::uint32_t frame_count = 0;
    for (bool complete = false; !complete; ++frame_count)
    {
        ASSERT_LT(frame_count, 1000U);
        EXPECT_EQ(world.differenceFromRebuilt({inside(1, 1, 1)}), "");
        if (frame_count == 2)
        {
            world.setPose(object, inside(0, 0, 0)); // counts for the next update
        }
        test::runFrame(device(), world.octree(),
                       [&](vk::FrameGraph& graph) { complete = world.octree().update(graph, 1e-6); });
        EXPECT_EQ(world.octree().isUpdating(), !complete);
    }
    EXPECT_GT(frame_count, 10U);
    EXPECT_EQ(world.differenceFromRebuilt({inside(2, 0, 1)}), "");
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(0, 0, 0)}), "");
}

TEST(DynamicOctree, KeepsSeveralFramesInFlight)
{
    DynamicWorld world(device(), {.depth = 6, .frames_in_flight = 3});
    const DynamicObjectId object = world.add(inside(1, 1, 1));
    world.update();
    struct Flight
    {
        std::uint64_t frame;
        vk::Submission submission;
    };
    std::deque<Flight> flights;
    for (int i = 0; i < 12; ++i)
    {
        world.setPose(object, inside(i % 4, i / 4, 1));
        const std::uint64_t frame = world.octree().beginFrame();
        flights.push_back({frame, device().submit(
                                      [&](vk::FrameGraph& graph)
                                      {
                                          world.octree().update(graph);
                                          graph.releaseToHost();
                                      })});
        if (flights.size() == 3)
        {
            flights.front().submission.wait();
            for (const UpdateReport& report : world.octree().frameDone(flights.front().frame))
            {
                EXPECT_EQ(report.failed, 0U);
            }
            flights.pop_front();
        }
    }
    for (Flight& flight : flights)
    {
        flight.submission.wait();
        world.octree().frameDone(flight.frame);
    }
    if (world.octree().needsUpdate())
    {
        world.update();
    }
    EXPECT_EQ(world.differenceFromRebuilt({inside(3, 2, 1)}), "");
}

TEST(DynamicOctree, StartsWithRoomForOne)
{
    DynamicWorld world(device(), {.depth = 6, .minimal_capacities = true});
    const DynamicObjectId object = world.add(inside(0, 0, 0));
    world.setPose(object, inside(1, 1, 1));
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({inside(1, 1, 1)}), "");
}

TEST(DynamicOctree, OneObjectGivesWhatARebuildGives)
{
    for (const std::uint32_t depth : {5U, 1U, 2U, 6U, 13U})
    {
        SCOPED_TRACE(depth);
        DynamicWorld world(device(), {.depth = depth});
        const DynamicObjectId object = world.add(inside(0, 0, 0));
        world.setPose(object, inside(1, 1, 1));
        const UpdateReport report = world.update();
        EXPECT_EQ(report.failed, 0U);
        EXPECT_GT(report.dynamic_count, 0U);
        EXPECT_EQ(world.differenceFromRebuilt({inside(1, 1, 1)}), "");
    }
}

} // namespace
} // namespace zvo
