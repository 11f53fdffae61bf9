// SPDX-License-Identifier: MIT
// Dynamic objects merged with a DAG. What is shown equals a full rebuild, and the DAG does not change.
#include "core/dynamic/dynamic_octree.h"
#include "runtime/trees.h"
#include "support/dynamic_world.h"
#include "support/engine_device.h"
#include "support/octree_contents.h"
#include "support/trace_octrees.h"
#include "support/tree_comparison.h"
#include "support/tree_words.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::DynamicScenery;
using test::DynamicSetting;
using test::DynamicWorld;
using test::Item;
using Kind = test::Placement::Kind;

using test::device;

constexpr Item kMergedMiddle = {0, {Kind::Inside, {1, 1, 1}}};
constexpr Item kTurned = {0, {Kind::Turned, {2, 1, 2}}};
constexpr Item kMergedBent = {2, {Kind::Inside, {1, 2, 1}}, 3};

// Compares what is shown with a rebuild, by cells and by pictures.
void expectRebuilt(DynamicWorld& world, const std::multiset<Item>& items, bool with_pictures)
{
    EXPECT_EQ(world.differenceFromRebuilt(items), "");
    if (with_pictures)
    {
        const double edge = world.setting().grid().resolution();
        const ViewCamera close =
            ViewCamera::lookAt(edge * glm::dvec3(1.27, 1.11, 1.47), edge * glm::dvec3(0.43, 0.51, 0.39), 0.9);
        test::TreeComparison(device(), world.rebuilt(items)->octree, world.octree().tree()).pictures(close);
    }
}

TEST(DynamicSvdagMerge, AveragedObjectsGiveWhatARebuildGives)
{
    for (const std::uint32_t depth : {6U, 1U, 2U, 5U, 7U, 13U})
    {
        SCOPED_TRACE("depth " + std::to_string(depth));
        const bool with_pictures = depth > 4 && depth < 13;
        DynamicWorld world(device(), {.depth = depth, .compressed = true, .minimal_capacities = depth % 2 != 0});
        expectRebuilt(world, {}, with_pictures);
        const DynamicObjectId first = world.add(kMergedMiddle);
        world.update();
        expectRebuilt(world, {kMergedMiddle}, false);
        const DynamicObjectId second = world.add(kTurned);
        world.add(kMergedBent);
        world.update();
        expectRebuilt(world, {kMergedMiddle, kTurned, kMergedBent}, with_pictures);
        world.setPose(first, {0, {Kind::Mirrored, {0, 2, 1}}});
        world.octree().remove(second);
        world.update();
        expectRebuilt(world, {{0, {Kind::Mirrored, {0, 2, 1}}}, kMergedBent}, false);
        EXPECT_TRUE(world.undo());
        expectRebuilt(world, {kMergedMiddle, kTurned, kMergedBent}, false);
        EXPECT_TRUE(world.undo());
        EXPECT_TRUE(world.undo());
        expectRebuilt(world, {}, with_pictures);
    }
}

TEST(DynamicSvdagMerge, NothingOfTheDagIsEverWritten)
{
    const DynamicSetting setting = {.depth = 6, .compressed = true, .minimal_capacities = true};
    DynamicScenery scenery(device(), true);
    DeviceTree fixed = scenery.buildStatic(setting);
    const std::uint64_t node_end = fixed.nodes.count();
    ASSERT_GT(fixed.lists.entry_count, 100U);
    const std::uint64_t emissive_count = fixed.emission.count();
    const auto bytes = [&](const DeviceTree& dag)
    { return test::staticWords(device(), dag, node_end, emissive_count); };
    const gpu::Node root = device().download(fixed.nodes, 0, 1).front();
    const std::vector<gpu::uint> before = bytes(fixed);
    DynamicOctree octree(device(), std::move(fixed), setting.options(scenery.emissionScale()));
    EXPECT_EQ(octree.staticRoot(), node_end);
    const auto expectUnchanged = [&]
    {
        EXPECT_TRUE(bytes(octree.tree()) == before);
        const gpu::Node shown = device().download(octree.tree().nodes, octree.staticRoot(), 1).front();
        EXPECT_EQ(shown.mask_lo, root.mask_lo);
        EXPECT_EQ(shown.base_lo, root.base_lo);
        EXPECT_EQ(shown.mask_hi, root.mask_hi);
        EXPECT_EQ(shown.base_hi, root.base_hi);
    };
    expectUnchanged();
    for (const Item& item : {kMergedMiddle, kTurned, kMergedBent})
    {
        octree.add(scenery.object(item.mesh, true), scenery.poseOf(item));
        test::updateAll(device(), octree);
        expectUnchanged();
    }
    EXPECT_TRUE(test::undo(device(), octree));
    expectUnchanged();
}

TEST(DynamicSvdagMerge, UndoGivesTheSameBytes)
{
    DynamicWorld world(device(), {.depth = 6, .compressed = true});
    const DynamicObjectId object = world.add(kMergedMiddle);
    world.update();
    const auto bytes = [&]
    {
        const DeviceTree& octree = world.octree().tree();
        std::vector<gpu::uint> words;
        test::addWords(words, device(), octree.nodes, 0, octree.nodes.count());
        test::addWords(words, device(), octree.node_attributes, 0, octree.node_attributes.count());
        test::addWords(words, device(), octree.voxel_attributes, 0, octree.voxel_attributes.count());
        return words;
    };
    const std::vector<gpu::uint> before = bytes();
    world.setPose(object, kTurned);
    world.update();
    EXPECT_FALSE(bytes() == before);
    EXPECT_TRUE(world.undo());
    const std::vector<gpu::uint> after = bytes();
    // The overlay that was undone stays, where memory was free before.
    const RootEntry step = world.octree().history().current();
    const DeviceTree& octree = world.octree().tree();
    const std::uint64_t words_per_node = sizeof(gpu::Node) / sizeof(gpu::uint);
    const std::uint64_t end = words_per_node * (step.region->first_node + step.region->node_capacity);
    ASSERT_LT(end, octree.nodes.count() * words_per_node);
    EXPECT_TRUE(std::equal(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(end), after.begin()));
}

TEST(DynamicSvdagMerge, OverlaysTakeEightBytesANodeMoreThanOnAnOctree)
{
    const DynamicSetting setting = {.depth = 6};
    std::array<std::uint64_t, 2> bytes{};
    std::array<UpdateReport, 2> reports;
    for (const bool compressed : {false, true})
    {
        DynamicSetting with = setting;
        with.compressed = compressed;
        DynamicScenery scenery(device(), true);
        DynamicOctree octree(device(), scenery.buildStatic(with), with.options(scenery.emissionScale()));
        octree.add(scenery.object(0, true), scenery.poseOf(kMergedMiddle));
        reports.at(compressed ? 1 : 0) = test::updateAll(device(), octree);
        bytes.at(compressed ? 1 : 0) = octree.history().entryBytes();
    }
    EXPECT_EQ(reports[1].node_count, reports[0].node_count);
    EXPECT_EQ(bytes[1], bytes[0] + sizeof(gpu::BeforeChild) * reports[0].node_count);
}

TEST(DynamicSvdagMerge, MoreNodesThanKernelsReachAreRefused)
{
    const test::Codes codes = {0, 5, 70};
    vk::DeletionQueue deletion_queue;
    const auto make = [&](std::uint64_t room)
    {
        DeviceTree dag = compress(device(), test::octreeOf(device(), codes, 3)).dag;
        auto octree =
            std::make_unique<OverlayBuffers>(device(), std::move(dag), OverlayContents{false, 0.0F}, deletion_queue);
        octree->reserve(room);
        device().perform([&](vk::FrameGraph& graph, vk::DeletionQueue& later) { octree->settle(graph, later); });
        return octree;
    };
    EXPECT_GE(make(1)->arena().largestFreeNodes(), 1U);
    try
    {
        make(std::uint64_t{1} << 30);
        FAIL() << "no error";
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Memory);
        EXPECT_NE(
            std::string(error.what()).find("more than the 536870912 nodes or 2147483648 voxels that kernels reach"),
            std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace zvo
