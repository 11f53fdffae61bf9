// SPDX-License-Identifier: MIT
// Dynamic objects above edited voxels, case by case.
#include "oracle/morton.h"
#include "support/dynamic_updates.h"
#include "support/edit_machine.h"
#include "support/engine_device.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::Cell;
using test::Command;
using test::DynamicScenery;
using test::DynamicSetting;
using test::EditMachine;
using test::EditModel;
using test::Item;
using Action = Command::Action;
using Kind = test::Placement::Kind;

using test::dab;
using test::device;

constexpr Item kMiddle = {0, {Kind::Inside, {1, 1, 1}}};
constexpr Item kApart = {0, {Kind::Mirrored, {2, 0, 2}}};

Command add(const Item& item)
{
    return {.action = Action::Add, .item = item};
}

std::vector<Cell> mergedCells(DynamicScenery& scenery, const DynamicSetting& setting, const EditModel& model,
                              const std::multiset<Item>& items)
{
    return model
        .merged(setting.merge, scenery.rebuilt(setting, false, items)->cells,
                scenery.rebuilt(setting, true, items)->cells)
        .cells();
}

// A stroke ends the dynamic objects' history, because they were merged with another tree.
TEST(EditDynamicObjects, HaveAHistoryAboveEachStroke)
{
    DynamicScenery scenery(device(), true);
    for (const bool compressed : {false, true})
    {
        SCOPED_TRACE(compressed);
        const DynamicSetting setting = {.depth = 5, .compressed = compressed};
        EditMachine machine(device(), setting, DynamicOptions().edits, scenery);
        DynamicOctree& octree = machine.octree();
        const auto expectShown = [&](const std::vector<Cell>& expected)
        { EXPECT_EQ(test::difference(test::cellsOf(device(), octree.tree()), expected), ""); };
        const auto move = [&](bool undo) { return undo ? test::undo(device(), octree) : test::redo(device(), octree); };
        machine.run(dab(BrushAction::Carve, {20, 16, 12}, 7));
        machine.run({Action::EndStroke});
        machine.run(add(kMiddle));
        machine.run({Action::Settle});
        machine.run({.action = Action::Move, .item = kApart});
        machine.run({Action::Settle});
        EXPECT_EQ(octree.history().undoCount(), 2U);
        EXPECT_TRUE(move(true));
        expectShown(mergedCells(scenery, setting, machine.model(), {kMiddle}));
        EXPECT_TRUE(move(true));
        expectShown(machine.model().cells());
        EXPECT_FALSE(move(true));
        EXPECT_TRUE(move(false));
        EXPECT_TRUE(move(false));
        expectShown(mergedCells(scenery, setting, machine.model(), {kApart}));

        machine.run(dab(BrushAction::Fill, {6, 20, 6}, 4));
        machine.run({Action::Submit});
        EXPECT_EQ(octree.history().undoCount() + octree.history().redoCount(), 0U);
        EXPECT_TRUE(octree.needsUpdate());
        machine.run({Action::Settle});
        EXPECT_TRUE(move(true));
        expectShown(machine.model().cells());
        EXPECT_FALSE(move(true));
    }
}

// In leaves that a brush has changed, a dynamic object's voxels have the object's attributes; in others they have the
// mean.
TEST(EditDynamicObjects, AreAveragedOnlyWithLeavesThatNoBrushHasChanged)
{
    DynamicScenery scenery(device(), true);
    const DynamicSetting setting = {.depth = 6};
    EditMachine machine(device(), setting, DynamicOptions().edits, scenery);
    const std::uint32_t leaf_level = setting.grid().nodeLevels();
    const auto voxels = [&](const std::vector<Cell>& cells)
    {
        std::map<std::uint64_t, Cell> found;
        for (const Cell& cell : cells)
        {
            if (cell.level == leaf_level)
            {
                found[cell.code] = cell;
            }
        }
        return found;
    };
    const std::map<std::uint64_t, Cell> fixed = voxels(scenery.rebuilt(setting, true, {})->cells);
    const std::map<std::uint64_t, Cell> moving = voxels(scenery.rebuilt(setting, false, {kMiddle})->cells);
    const std::map<std::uint64_t, Cell> means = voxels(scenery.rebuilt(setting, true, {kMiddle})->cells);
    std::vector<std::uint64_t> shared; // voxels whose mean differs from the dynamic object's attributes
    for (const auto& [code, voxel] : moving)
    {
        if (fixed.contains(code) && !(voxel == means.at(code)))
        {
            shared.push_back(code);
        }
    }
    ASSERT_GT(shared.size(), 1U);
    machine.run(dab(BrushAction::Paint, glm::ivec3(oracle::mortonDecode(shared.front())), 2));
    machine.run(add(kMiddle));
    machine.run({Action::Settle});
    std::set<std::uint64_t> painted; // leaves
    for (const auto& [code, voxel] : machine.model().voxels())
    {
        if (!(voxel == fixed.at(code)))
        {
            painted.insert(code >> 6);
        }
    }
    std::size_t changed_count = 0;
    std::size_t mean_count = 0;
    for (const auto& [code, voxel] : voxels(test::cellsOf(device(), machine.octree().tree())))
    {
        if (fixed.contains(code) && moving.contains(code) && !(moving.at(code) == means.at(code)))
        {
            const bool is_changed = painted.contains(code >> 6);
            EXPECT_TRUE(voxel == (is_changed ? moving : means).at(code)) << code;
            ++(is_changed ? changed_count : mean_count);
        }
    }
    EXPECT_GT(changed_count, 0U);
    EXPECT_GT(mean_count, 0U);
}

// Each slice of an update is followed by a brush.
TEST(EditDynamicObjects, AnUpdateUnderWayIsGivenUpForAStroke)
{
    DynamicScenery scenery(device(), true);
    for (std::size_t slices = 1; slices < 12; ++slices)
    {
        EditMachine machine(device(), {.depth = 5, .compressed = slices % 2 == 0}, DynamicOptions().edits, scenery);
        machine.run(dab(BrushAction::Carve, {20, 16, 12}, 5));
        machine.run({Action::EndStroke});
        machine.run(add(kMiddle));
        machine.run(add(kApart));
        for (std::size_t i = 0; i < slices; ++i)
        {
            machine.run({Action::Slice});
            machine.run({Action::Submit});
        }
        const bool was_updating = machine.octree().isUpdating();
        EXPECT_TRUE(was_updating || slices > 2);
        machine.run(slices % 3 == 0 ? Command{Action::Undo} : dab(BrushAction::Fill, {16, 16, 16}, 6));
        machine.run({Action::Submit});
        EXPECT_FALSE(machine.octree().isUpdating());
        EXPECT_TRUE(machine.octree().needsUpdate());
        machine.run({Action::Settle});
        machine.finish();
    }
}

} // namespace
} // namespace zvo
