// SPDX-License-Identifier: MIT
// Dynamic updates at their limits give a defined result, or an error that says what is wrong.
#include "core/base/kernels.h"
#include "core/dynamic/dynamic_octree.h"
#include "runtime/trees.h"
#include "support/ballast.h"
#include "support/device.h"
#include "support/dynamic_world.h"
#include "support/engine_device.h"
#include "support/scenes.h"
#include "zvo/error.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::Cell;
using test::DynamicSetting;
using test::DynamicWorld;
using test::Item;
using test::Placement;
using Kind = Placement::Kind;

constexpr std::uint64_t kLimitBytes = 256 << 20;

using test::device;

vk::HeadlessOptions limitedOptions()
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.memory_budget_bytes = kLimitBytes;
    return options;
}

void expectError(ErrorCode code, const std::string& message, const std::function<void()>& call)
{
    try
    {
        call();
        FAIL() << "no error: " << message;
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), code);
        EXPECT_TRUE(std::regex_search(error.what(), std::regex(message))) << error.what();
    }
}

constexpr Item kMiddle = {0, {Kind::Inside, {1, 1, 1}}};

// The memory is less than an update needs; every allocation fails in turn.
TEST(DynamicEdges, WithoutMemoryWhatWasShownStaysShown)
{
    vk::HeadlessDevice limited(limitedOptions(), zvoKernels());
    std::set<std::string> needs;
    for (std::size_t pieces_left = 0; pieces_left < 200; pieces_left += 1 + pieces_left / 6)
    {
        SCOPED_TRACE(pieces_left);
        DynamicWorld world(limited, {.depth = 5, .minimal_capacities = true});
        const bool new_layer = pieces_left % 2 != 0;
        world.add(kMiddle);
        const DynamicObjectId object = world.add(kMiddle);
        world.update(); // its nodes are those of only one of two overlapping dynamic objects
        const std::vector<Cell> before = world.shown();
        const Item apart = {0, {Kind::Mirrored, {2, 0, 2}}};
        std::multiset<Item> items = {kMiddle, apart};
        world.setPose(object, apart);
        if (new_layer)
        {
            items.insert(apart);
            world.add(apart);
        }
        auto rest = test::ballast(limited, pieces_left);
        bool is_enough = true;
        for (int i = 0; i < 2 && is_enough; ++i)
        {
            try
            {
                world.update();
            }
            catch (const Error& error)
            {
                is_enough = false;
                EXPECT_EQ(error.code(), ErrorCode::Memory);
                EXPECT_NE(std::string(error.what()).find("but the limit is 268435456: raise the limit"),
                          std::string::npos)
                    << error.what();
                needs.insert(std::string(error.what()).substr(0, std::string(error.what()).find(" needs ")));
            }
        }
        EXPECT_FALSE(world.octree().isUpdating());
        rest.clear();
        if (!is_enough)
        {
            EXPECT_EQ(world.differenceFrom(before), "");
        }
        world.update();
        EXPECT_EQ(world.differenceFromRebuilt(items), "");
    }
    EXPECT_TRUE(needs.contains("room for overlays"));
    EXPECT_TRUE(needs.contains("the voxels of a dynamic object"));
}

// Frames in flight fill the room for overlays. The next update waits, and the complete one is shown.
TEST(DynamicEdges, WithoutMemoryToGrowAnUpdateWaitsForFramesInFlight)
{
    vk::HeadlessDevice limited(limitedOptions(), zvoKernels());
    DynamicWorld world(limited, {.depth = 6, .frames_in_flight = 64}, {1, UINT64_MAX});
    const std::array items = {kMiddle, Item{0, {Kind::Turned, {1, 1, 1}}}};
    const DynamicObjectId object = world.add(items[0]);
    for (std::size_t i = 0; i < 4; ++i)
    {
        world.setPose(object, items[i % 2]);
        world.update();
    }
    const std::array expected = {world.rebuilt({items[0]})->cells, world.rebuilt({items[1]})->cells};
    auto rest = test::ballast(limited, 0);
    struct Flight
    {
        std::uint64_t frame;
        vk::Submission submission;
    };
    std::deque<Flight> flights;
    std::size_t complete_count = 0;
    for (bool is_complete = true; is_complete; ++complete_count)
    {
        ASSERT_LT(flights.size(), 60U) << "the room for overlays never ended";
        world.setPose(object, items[complete_count % 2]);
        const std::uint64_t frame = world.octree().beginFrame();
        flights.push_back({frame, limited.submit(
                                      [&](vk::FrameGraph& graph)
                                      {
                                          is_complete = world.octree().update(graph);
                                          graph.releaseToHost();
                                      })});
    }
    --complete_count; // the last one was not complete
    ASSERT_GT(complete_count, 0U);
    EXPECT_TRUE(world.octree().needsUpdate());
    EXPECT_FALSE(world.octree().isUpdating());
    for (Flight& flight : flights)
    {
        flight.submission.wait();
        for (const UpdateReport& report : world.octree().frameDone(flight.frame))
        {
            EXPECT_EQ(report.failed, 0U);
        }
    }
    EXPECT_TRUE(world.octree().needsUpdate());
    rest.clear();
    EXPECT_EQ(world.differenceFrom(expected.at((complete_count - 1) % 2)), "");
    world.update();
    EXPECT_EQ(world.differenceFrom(expected.at(complete_count % 2)), "");
}

TEST(DynamicEdges, ObjectsThatCoverNothingShowTheStaticOctree)
{
    DynamicWorld world(device(), {.depth = 5});
    const DynamicObjectId object = world.add(kMiddle);
    for (const Kind kind : {Kind::Outside, Kind::Point, Kind::Nan, Kind::Huge})
    {
        SCOPED_TRACE(static_cast<int>(kind));
        world.setPose(object, {0, {kind, {1, 2, 1}}});
        const UpdateReport report = world.update();
        EXPECT_EQ(report.failed, 0U);
        EXPECT_EQ(report.dynamic_count, 0U);
        EXPECT_EQ(report.node_count, 1U);
        EXPECT_EQ(world.differenceFromRebuilt({}), "");
    }
}

// A dynamic object of 70,000 triangles in a point covers voxels only in conservative coverage. These voxels have that
// many fragments.
TEST(DynamicEdges, MoreFragmentsThanSumsHoldAreAveragedWithFewerBits)
{
    constexpr std::uint32_t kCount = 70'000;
    for (const bool on_static : {false, true})
    {
        SCOPED_TRACE(on_static);
        Scene fixed = test::boxScene(glm::vec3(1.1F), glm::vec3(2.9F));
        fixed.materials[0].base_color = {0.9F, 0.1F, 0.4F, 1.0F};
        Scene dot = test::randomTriangles(5, kCount, 1.0F);
        dot.materials[0].base_color = {0.1F, 0.6F, 0.3F, 1.0F};
        const glm::mat4 place =
            glm::scale(glm::translate(glm::mat4(1.0F), glm::vec3(on_static ? 1.1F : 12.3F)), glm::vec3(0.0F));
        const Grid grid = {.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 4};
        BuildOptions build;
        build.coverage = Coverage::Conservative;
        build.keep_sums = true;
        DynamicOctree octree(device(), buildOctree(device(), uploadScene(device(), fixed, true), grid, build).octree,
                             {.coverage = Coverage::Conservative, .merge = MergeRule::Average});
        const std::vector<Cell> before = test::cellsOf(device(), octree.tree());
        const DynamicObjectId object = octree.add(uploadDynamicMesh(device(), dot, true, 0), {{place}, {}, {}});
        std::uint32_t failed = 0;
        const auto update = [&]
        {
            do
            {
                for (const UpdateReport& report :
                     test::runFrame(device(), octree, [&](vk::FrameGraph& graph) { octree.update(graph); }))
                {
                    failed |= report.failed;
                }
            } while (octree.needsUpdate());
        };
        update();
        EXPECT_NE(failed & gpu::kFailedFragments, 0U);

        Scene all = fixed;
        dot.instances[0].transform = place;
        all.append(std::move(dot));
        const std::vector<Cell> expected =
            test::cellsOf(device(), buildOctree(device(), uploadScene(device(), all, true), grid, build).octree);
        const std::vector<Cell> shown = test::cellsOf(device(), octree.tree());
        ASSERT_EQ(shown.size(), expected.size());
        for (std::size_t i = 0; i < shown.size(); ++i)
        {
            ASSERT_EQ(shown[i].level, expected[i].level);
            ASSERT_EQ(shown[i].code, expected[i].code);
            for (std::uint32_t shift = 0; shift < 24; shift += 8) // a rebuild drops bits that the static sums keep
            {
                EXPECT_NEAR((shown[i].attribute.color >> shift) & 255U, (expected[i].attribute.color >> shift) & 255U,
                            1);
            }
        }
        octree.remove(object);
        update();
        EXPECT_EQ(test::difference(test::cellsOf(device(), octree.tree()), before), "");

        // With fewer fragments, results are equal bit for bit again from the second update on.
        const Scene box = test::boxScene(glm::vec3(2.2F), glm::vec3(4.4F));
        octree.add(uploadDynamicMesh(device(), box, true, 0), {{glm::mat4(1.0F)}, {}, {}});
        update();
        update();
        fixed.append(Scene(box));
        EXPECT_EQ(
            test::difference(
                test::cellsOf(device(), octree.tree()),
                test::cellsOf(device(), buildOctree(device(), uploadScene(device(), fixed, true), grid, build).octree)),
            "");
    }
}

TEST(DynamicEdges, ManyLayersAtOnceAreWhatARebuildIs)
{
    DynamicWorld world(device(), {.depth = 5}, {1, UINT64_MAX});
    std::multiset<Item> items;
    for (int i = 0; i < 256; ++i)
    {
        const Item item = {i % 8 == 0 ? 0U : 1U,
                           {i % 5 == 0 ? Kind::Turned : Kind::Inside, {i % 4, i / 4 % 4, i / 16 % 4}}};
        items.insert(item);
        world.add(item);
    }
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt(items), "");
}

TEST(DynamicEdges, MoreObjectsThanLayersAreRefused)
{
    DynamicWorld world(device(), {.depth = 5}, {1, UINT64_MAX});
    for (std::uint32_t i = 0; i < gpu::kLayersMax; ++i)
    {
        world.add(kMiddle);
    }
    expectError(ErrorCode::Usage, "takes 1024 dynamic objects at most", [&] { world.add(kMiddle); });
}

TEST(DynamicEdges, TheHistoryKeepsAsManyEntriesAsItMay)
{
    DynamicWorld world(device(), {.depth = 4}, {3, UINT64_MAX});
    const DynamicObjectId object = world.add(kMiddle);
    std::vector<std::vector<Cell>> shown;
    for (int i = 0; i < 8; ++i)
    {
        world.setPose(object, {0, {Kind::Inside, {i % 4, 1, i / 4}}});
        world.update();
        shown.push_back(world.shown());
    }
    EXPECT_EQ(world.octree().history().undoCount(), 3U);
    for (const std::size_t step : {6U, 5U})
    {
        EXPECT_TRUE(world.undo());
        EXPECT_EQ(world.differenceFrom(shown[step]), "");
    }
    EXPECT_TRUE(world.undo()); // the oldest entry is always the static octree
    EXPECT_EQ(world.differenceFromRebuilt({}), "");
    EXPECT_FALSE(world.undo());
    for (const std::size_t step : {5U, 6U, 7U})
    {
        EXPECT_TRUE(world.redo());
        EXPECT_EQ(world.differenceFrom(shown[step]), "");
    }
    EXPECT_FALSE(world.redo());
}

TEST(DynamicEdges, TheHistoryKeepsAsManyBytesAsItMay)
{
    for (const std::uint64_t bytes_max : {std::uint64_t{1}, std::uint64_t{100'000}})
    {
        SCOPED_TRACE(bytes_max);
        DynamicWorld world(device(), {.depth = 5}, {1000, bytes_max});
        const DynamicObjectId object = world.add(kMiddle);
        std::size_t steps = 0;
        for (int i = 0; i < 24; ++i)
        {
            world.setPose(object, {0, {Kind::Inside, {i % 4, 1, i / 4 % 4}}});
            world.update();
            const RootHistory& history = world.octree().history();
            EXPECT_TRUE(history.entryBytes() <= bytes_max || history.undoCount() == 1) << history.entryBytes();
            steps = std::max(steps, history.undoCount());
        }
        EXPECT_EQ(world.differenceFromRebuilt({{0, {Kind::Inside, {3, 1, 1}}}}), "");
        EXPECT_EQ(steps > 1, bytes_max > 1);
        EXPECT_LT(steps, 24U);
    }
}

TEST(DynamicEdges, WhatMakesNoSenseIsRefused)
{
    DynamicWorld world(device(), {.depth = 3});
    const DynamicObjectId object = world.add(kMiddle);
    world.update();
    const Pose pose = world.scenery().poseOf(kMiddle);
    Pose shorter = pose;
    shorter.transforms.pop_back();
    const std::shared_ptr<const DynamicMesh> mesh = world.scenery().object(0, true);
    expectError(ErrorCode::Usage, "5 instances was given 4 transforms",
                [&] { world.octree().setPose(object, shorter); });
    expectError(ErrorCode::Usage, "5 instances was given 0 transforms", [&] { world.octree().add(mesh, {}); });
    expectError(ErrorCode::Usage, "no dynamic object 7", [&] { world.octree().setPose(7, pose); });
    expectError(ErrorCode::Usage, "no dynamic object 0", [&] { world.octree().remove(0); });
    expectError(ErrorCode::Usage, "without attributes",
                [&] { world.octree().add(world.scenery().object(0, false), pose); });
    Scene morphed = test::boxScene(glm::vec3(1.0F), glm::vec3(2.0F));
    morphed.primitives[0].morph_targets = {{std::vector<glm::vec3>(morphed.primitives[0].positions.size()), {}}};
    const auto morphed_mesh = uploadDynamicMesh(device(), morphed, true, world.scenery().emissionScale());
    expectError(ErrorCode::Usage, "0 morph weights for instance 0",
                [&] {
                    world.octree().add(morphed_mesh, {{glm::mat4(1.0F)}, {}, {}});
                });
    world.octree().remove(object);
    expectError(ErrorCode::Usage, "no dynamic object 1", [&] { world.octree().remove(object); });
    EXPECT_EQ(world.update().entry, 0U); // only the static octree is left
    EXPECT_EQ(world.differenceFromRebuilt({}), "");

    const DynamicSetting setting = {.depth = 3};
    const float scale = world.scenery().emissionScale();
    const auto make = [&](const DynamicOptions& options)
    { return DynamicOctree(device(), world.scenery().buildStatic(setting), options); };
    DynamicOptions options = setting.options(scale);
    options.frames_in_flight = 0;
    expectError(ErrorCode::Usage, "a frame in flight", [&] { make(options); });
    options = setting.options(scale);
    options.history.entries_max = 0;
    expectError(ErrorCode::Usage, "an entry of the history", [&] { make(options); });
    expectError(ErrorCode::Usage, "one emission scale", [&] { make(setting.options(2 * scale)); });
    DynamicSetting other = setting;
    other.merge = MergeRule::DynamicWins; // keeps no sums
    expectError(ErrorCode::Usage, "sums were kept",
                [&] { DynamicOctree(device(), world.scenery().buildStatic(other), setting.options(scale)); });
    expectError(ErrorCode::Usage, "attributes of 8 bytes",
                [&]
                {
                    DeviceTree built = world.scenery().buildStatic(setting);
                    packTree(device(), AttributeFormat::Bytes4, built);
                    DynamicOctree(device(), std::move(built), setting.options(scale));
                });
}

TEST(DynamicEdges, MoreUpdatesThanFramesInFlightAreRefused)
{
    DynamicWorld world(device(), {.depth = 3, .frames_in_flight = 1});
    world.add(kMiddle);
    world.update();
    const std::vector<UpdateReport> reports =
        test::runFrame(device(), world.octree(),
                       [&](vk::FrameGraph& graph)
                       {
                           for (int i = 0; i < 4; ++i)
                           {
                               EXPECT_TRUE(world.octree().update(graph));
                           }
                           expectError(ErrorCode::Usage, "frames in flight", [&] { world.octree().update(graph); });
                       });
    EXPECT_EQ(reports.size(), 4U);
    world.update();
    EXPECT_EQ(world.differenceFromRebuilt({kMiddle}), "");
}

} // namespace
} // namespace zvo
