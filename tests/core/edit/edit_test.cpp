// SPDX-License-Identifier: MIT
// A brush on voxels, case by case.
#include "core/edit/voxel_clip.h"
#include "core/tree/rgb9e5.h"
#include "support/dynamic_updates.h"
#include "support/edit_machine.h"
#include "support/engine_device.h"
#include "support/tree_words.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <string_view>

namespace zvo
{
namespace
{

using test::Command;
using test::DynamicScenery;
using test::DynamicSetting;
using test::EditMachine;

using test::dab;
using test::device;

DynamicScenery& scenery()
{
    static DynamicScenery scenery(device(), true);
    return scenery;
}

// What a frame graph's dump says.
std::size_t dispatchCount(std::string_view dump)
{
    std::size_t count = 0;
    for (const std::string_view kind : {" threads in ", ": indirect"})
    {
        for (std::size_t at = dump.find(kind); at != std::string_view::npos; at = dump.find(kind, at + 1))
        {
            ++count;
        }
    }
    return count;
}

TEST(Edit, ExtentIsWhatTheBrushReachesOfTheGrid)
{
    const Grid grid{.origin = {}, .voxel_size = 1.0F, .depth = 5}; // three levels of nodes, 32 voxels
    const auto extent = DabExtent::of({.center = {1, 16, 40}, .radius = 9}, grid);
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->box.lo, gpu::uvec3(0, 7, 31));
    EXPECT_EQ(extent->box.hi, gpu::uvec3(10, 25, 31));
    // 3 x 6 x 1 leaves in 1 x 2 x 1 nodes below the root.
    EXPECT_EQ(extent->cell_count, 1U + 2U + 18U);
    EXPECT_EQ(extent->inner_count, 3U);
    EXPECT_FALSE(DabExtent::of({.center = {1, 16, 41}, .radius = 9}, grid));
    EXPECT_FALSE(DabExtent::of({.center = gpu::ivec3(INT32_MIN), .radius = 9}, grid));
    EXPECT_THROW((void)DabExtent::of({.radius = gpu::kBrushRadiusMax + 1}, grid), Error);
}

TEST(Edit, ALongBoxIsSeveralDabs)
{
    const Grid grid{.origin = {}, .voxel_size = 1.0F, .depth = 9};
    const Brush box = {.shape = BrushShape::Box, .center = {500, 7, 9}, .radius = 2, .span = {-490, 0, 3}};
    EXPECT_THROW((void)DabExtent::of(box, grid), Error);
    std::uint64_t volume = 0;
    for (const Brush& part : partsOf(box, grid))
    {
        const VoxelBox reach = {glm::ivec3(DabExtent::of(part, grid)->box.lo),
                                glm::ivec3(DabExtent::of(part, grid)->box.hi)};
        volume += reach.volume();
    }
    EXPECT_EQ(volume, std::uint64_t{495} * 5 * 8);
    EXPECT_TRUE(partsOf({.center = {-5, 0, 0}, .radius = 4}, grid).empty());
}

TEST(Edit, ASphereCoversNothingFarAway)
{
    const Brush brush = {.center = {100, 100, 100}, .radius = 3};
    EXPECT_TRUE(brush.covers({102, 102, 102}));
    EXPECT_FALSE(brush.covers({103, 102, 102}));
    EXPECT_FALSE(brush.covers({100 + 65'536, 100, 100})) << "whose square is 0 in 32 bits";
}

TEST(Edit, EmissionBeyondTheBrightestIsTheBrightest)
{
    const std::uint32_t brightest = encodeRgb9e5(gpu::vec3(65408.0F, 0.0F, 128.0F));
    EXPECT_EQ(brightest, 511U | 1U << 18U | 31U << 27U);
    EXPECT_EQ(encodeRgb9e5(gpu::vec3(INFINITY, 0.0F, 128.0F)), brightest);
    EXPECT_EQ(encodeRgb9e5(gpu::vec3(1e30F, 0.0F, 128.0F)), brightest);
}

// Along x and y a code's coordinate changes its sign; along z it is folded to the other side.
TEST(VoxelClip, AMirrorTurnsPlacesAndNormals)
{
    VoxelClip clip({4, 2, 3});
    const auto code = [](int x, int y)
    { return (static_cast<std::uint32_t>(x) & 0xFFFFU) | static_cast<std::uint32_t>(y) << 16; };
    clip.set({0, 1, 1}, ClipVoxel{{7, code(10000, 5000)}, 3}); // z is 17767
    clip.set({3, 0, 2}, ClipVoxel{{8, gpu::kNoNormal}, 0});
    const VoxelClip x = clip.mirrored(0);
    EXPECT_EQ(x.at({3, 1, 1}), (ClipVoxel{{7, code(-10000, 5000)}, 3}));
    EXPECT_EQ(x.at({0, 0, 2}), (ClipVoxel{{8, gpu::kNoNormal}, 0}));
    EXPECT_EQ(clip.mirrored(1).at({0, 0, 1}), (ClipVoxel{{7, code(10000, -5000)}, 3}));
    EXPECT_EQ(clip.mirrored(2).at({0, 1, 1}), (ClipVoxel{{7, code(32767 - 5000, 32767 - 10000)}, 3}));
    for (const glm::length_t axis : {0, 1, 2})
    {
        const VoxelClip twice = clip.mirrored(axis).mirrored(axis);
        EXPECT_EQ(twice.at({0, 1, 1}), clip.at({0, 1, 1}));
        EXPECT_EQ(twice.voxelCount(), 2U);
    }
}

TEST(VoxelClip, AStampHasWhatTheGridHasOfIt)
{
    const Grid grid{.origin = {}, .voxel_size = 1.0F, .depth = 5};
    VoxelClip clip({3, 3, 3});
    clip.set({0, 0, 0}, ClipVoxel{{1, 2}, 3});
    clip.set({2, 1, 0}, ClipVoxel{{4, 5}, 6});
    const std::shared_ptr<const Stamp> cut = clip.stampAt({-1, 6, 9}, grid);
    ASSERT_NE(cut, nullptr);
    EXPECT_EQ(cut->box, (VoxelBox{{0, 6, 9}, {1, 8, 11}}));
    const VoxelClip left(*cut);
    EXPECT_EQ(left.voxelCount(), 1U);
    EXPECT_EQ(left.at({1, 1, 0}), (ClipVoxel{{4, 5}, 6}));
    EXPECT_EQ(clip.stampAt({-3, 0, 0}, grid), nullptr);
    EXPECT_EQ(clip.stampAt({-1, 31, 0}, grid), nullptr) << "no voxel of it is inside";
}

TEST(VoxelClip, AFloodGoesThroughNeighboursOfNearlyTheSameColour)
{
    VoxelClip clip({8, 8, 8});
    const auto gray = [](std::uint32_t level) { return ClipVoxel{{level * 0x010101U, 0}, 0}; };
    clip.set({1, 1, 1}, gray(100));
    clip.set({2, 2, 2}, gray(110)); // by a corner
    clip.set({3, 2, 2}, gray(90));
    clip.set({4, 2, 2}, gray(111)); // too bright
    clip.set({5, 2, 2}, gray(100));
    const Flood flood = floodFrom(clip, {1, 1, 1}, 10);
    EXPECT_EQ(flood.voxels.voxelCount(), 3U);
    EXPECT_TRUE(flood.voxels.at({3, 2, 2}));
    EXPECT_EQ(flood.reached, (VoxelBox{{1, 1, 1}, {3, 2, 2}}));
    EXPECT_EQ(floodFrom(clip, {1, 1, 1}, 11).voxels.voxelCount(), 5U);
    EXPECT_EQ(floodFrom(clip, {0, 1, 1}, 11).voxels.voxelCount(), 0U);
    EXPECT_TRUE(floodFrom(clip, {0, 1, 1}, 11).reached.isEmpty());
}

// The tree is empty at first, so that all voxels are the brush's.
TEST(Edit, SpheresAndBoxesHaveTheVoxelsTheyAreDefinedBy)
{
    for (const BrushShape shape : {BrushShape::Sphere, BrushShape::Box})
    {
        for (const std::uint32_t radius : {0U, 1U, 2U, 7U, gpu::kBrushRadiusMax})
        {
            EditMachine machine(device(), {.depth = 6, .has_static = false}, DynamicOptions().edits, scenery());
            machine.run(dab(BrushAction::Fill, {30, 31, 33}, radius, shape));
            machine.run({Command::Action::Settle});
            const std::uint64_t edge = std::min<std::uint64_t>(2 * radius + 1, 64);
            if (shape == BrushShape::Box)
            {
                EXPECT_EQ(machine.octree().edits().voxelCount(), edge * edge * edge);
            }
            else if (radius <= 2)
            {
                EXPECT_EQ(machine.octree().edits().voxelCount(), radius == 0 ? 1U : radius == 1 ? 19U : 81U);
            }
            machine.finish();
        }
    }
}

TEST(Edit, EverythingCanBeCarvedAwayAndFilledAgain)
{
    for (const bool compressed : {false, true})
    {
        EditMachine machine(device(), {.depth = 6, .compressed = compressed}, DynamicOptions().edits, scenery());
        machine.run(dab(BrushAction::Carve, {32, 32, 32}, gpu::kBrushRadiusMax, BrushShape::Box));
        machine.run({Command::Action::EndStroke});
        machine.run({Command::Action::Settle});
        EXPECT_EQ(machine.octree().edits().voxelCount(), 0U);
        machine.run(dab(BrushAction::Fill, {32, 32, 32}, 5));
        machine.run({Command::Action::Settle});
        machine.finish();
    }
}

// The work of a stroke does not depend on the scene's size.
TEST(Edit, WorkFollowsTheBrush)
{
    const Brush brush = {.center = {30, 31, 33}, .radius = 16};
    const auto small = DabExtent::of(brush, {.origin = {}, .voxel_size = 1.0F, .depth = 6});
    const auto large = DabExtent::of(brush, {.origin = {}, .voxel_size = 1.0F, .depth = 12});
    EXPECT_EQ(large->cell_count, small->cell_count + 3);
    EXPECT_LT(large->cell_count, 1000U);
}

// At 512^3, with what shows the result. Where a pass has nothing to do, a big GPU takes some microseconds for it.
TEST(Edit, ADabIsAtMostEightDispatches)
{
    for (const bool emits : {false, true})
    {
        for (const bool compressed : {false, true})
        {
            for (const std::uint32_t radius : {1U, 8U, gpu::kBrushRadiusMax})
            {
                DynamicScenery small(device(), emits);
                EditMachine machine(device(), {.depth = 9, .emits = emits, .compressed = compressed},
                                    DynamicOptions().edits, small);
                DynamicOctree& octree = machine.octree();
                EXPECT_EQ(octree.tree().emission_words.count() != 0, emits);
                std::string dump;
                for (int i = 0; i < 2; ++i) // the first dab makes the region
                {
                    const Brush brush = {.center = gpu::ivec3(480 + i), .radius = radius};
                    test::runFrame(device(), octree,
                                   [&](vk::FrameGraph& graph)
                                   {
                                       ASSERT_TRUE(octree.edit(graph, brush));
                                       dump = graph.dump();
                                   });
                }
                EXPECT_LE(dispatchCount(dump), emits ? 8U : 7U) << dump;
                EXPECT_EQ(dump.find("pass fill"), std::string::npos) << dump;
            }
        }
    }
}

TEST(Edit, ManyStrokesAndAsManyUndosLeaveTheSameBytes)
{
    constexpr int kStrokes = 60;
    for (const bool compressed : {false, true})
    {
        EditMachine machine(device(), {.depth = 6, .compressed = compressed}, {.entries_max = kStrokes}, scenery());
        const auto nodes = [&]
        {
            std::vector<gpu::uint> words;
            test::addWords(words, device(), machine.octree().tree().nodes, 0, machine.octree().staticRoot() + 1);
            return words;
        };
        const std::vector<gpu::uint> before = nodes();
        for (int i = 0; i < kStrokes; ++i)
        {
            const gpu::ivec3 center(i * 7 % 64, i * 11 % 64, i * 13 % 64);
            machine.run(dab(static_cast<BrushAction>(i % 3), center, 3 + i % 5));
            machine.run({Command::Action::EndStroke});
        }
        machine.run({Command::Action::Settle});
        for (int i = 0; i < kStrokes; ++i)
        {
            machine.run({Command::Action::Undo});
        }
        machine.run({Command::Action::Settle});
        EXPECT_EQ(nodes(), before);
        EXPECT_EQ(machine.octree().edits().redoCount(), static_cast<std::size_t>(kStrokes));
    }
}

} // namespace
} // namespace zvo
