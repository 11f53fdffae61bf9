// SPDX-License-Identifier: MIT
// What is shown, copied to an octree of its own.
#include "runtime/flatten.h"

#include "core/file/tree_check.h"
#include "runtime/trees.h"
#include "support/dynamic_scenery.h"
#include "support/dynamic_updates.h"
#include "support/edit_machine.h"
#include "support/engine_device.h"
#include "support/tree_samples.h"

#include <gtest/gtest.h>

namespace zvo
{
namespace
{

using test::DynamicScenery;
using test::DynamicSetting;

using test::device;

// Settings of octrees and DAGs, with and without attributes and emission.
std::vector<DynamicSetting> settings()
{
    std::vector<DynamicSetting> all;
    for (const bool compressed : {false, true})
    {
        for (const bool attributes : {false, true})
        {
            for (const std::uint32_t depth : {2U, 6U})
            {
                all.push_back(
                    {.depth = depth, .attributes = attributes, .emits = attributes, .compressed = compressed});
            }
        }
    }
    return all;
}

TEST(FlattenTree, OfWhatWasJustBuiltIsWhatIsDownloaded)
{
    for (const test::TreeSample& sample : test::treeSamples())
    {
        if (isPacked(sample.tree.attributeFormat()))
        {
            EXPECT_ANY_THROW((void)flattenTree(device(), uploadTree(device(), sample.tree)));
            continue;
        }
        const DeviceTree uploaded = uploadTree(device(), sample.tree);
        const TreeData flat = flattenTree(device(), uploaded);
        EXPECT_EQ(checkTree(flat), std::nullopt) << sample.name;
        EXPECT_EQ(flat.structure, TreeStructure::Svo);
        const bool is_dag = sample.tree.structure == TreeStructure::Svdag;
        EXPECT_EQ(test::treeDifference(is_dag ? test::dagOf(flat) : flat, sample.tree), "") << sample.name;
    }
}

TEST(FlattenTree, OfMergedObjectsIsWhatVoxelizingEverythingGives)
{
    DynamicScenery scenery(device(), true);
    for (const DynamicSetting& setting : settings())
    {
        SCOPED_TRACE(::testing::PrintToString(setting));
        DynamicOctree octree(device(), scenery.buildStatic(setting), setting.options(scenery.emissionScale()));
        const test::Item item = {1, {test::Placement::Kind::Turned, {1, 2, 1}}};
        octree.add(scenery.object(item.mesh, setting.attributes), scenery.poseOf(item));
        test::updateAll(device(), octree);
        const TreeData expected = downloadTree(device(), scenery.rebuilt(setting, true, {item})->octree);
        EXPECT_EQ(test::treeDifference(flattenTree(device(), octree.tree()), expected), "");
    }
}

TEST(FlattenTree, OfAnEditedTreeHasWhatTheModelHas)
{
    DynamicScenery scenery(device(), true);
    std::vector<DynamicSetting> all = settings();
    all.push_back({.depth = 6, .filled = true});
    for (const DynamicSetting& setting : all)
    {
        SCOPED_TRACE(::testing::PrintToString(setting));
        test::EditMachine machine(device(), setting, DynamicOptions().edits, scenery);
        const auto edge = static_cast<int>(setting.grid().resolution());
        for (const BrushAction action : {BrushAction::Carve, BrushAction::Fill, BrushAction::Paint})
        {
            const int at = edge / 2 + static_cast<int>(action) * edge / 8;
            machine.run(
                {test::Command::Action::Dab,
                 {BrushShape::Sphere, action, gpu::ivec3(at), 5 + static_cast<std::uint32_t>(action), 0x40FF20}});
        }
        machine.run({test::Command::Action::Settle, {}});
        const TreeData flat = flattenTree(device(), machine.octree().tree());
        EXPECT_EQ(checkTree(flat), std::nullopt);
        const DeviceTree again = uploadTree(device(), flat);
        EXPECT_EQ(test::difference(test::cellsOf(device(), again), machine.model().cells()), "");
    }
}

TEST(FlattenTree, OfNothingIsNothing)
{
    DynamicScenery scenery(device(), false);
    const DynamicSetting setting = {.emits = false, .has_static = false};
    DynamicOctree octree(device(), scenery.buildStatic(setting), setting.options(scenery.emissionScale()));
    const TreeData flat = flattenTree(device(), octree.tree());
    EXPECT_EQ(checkTree(flat), std::nullopt);
    EXPECT_TRUE(flat.nodes.empty());
}

} // namespace
} // namespace zvo
