// SPDX-License-Identifier: MIT
// A brush on voxels, case by case.
#include "support/dynamic_updates.h"
#include "support/edit_machine.h"
#include "support/engine_device.h"
#include "support/tree_words.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

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
