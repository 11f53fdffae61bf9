// SPDX-License-Identifier: MIT
// DAGs of tiles are joined to the DAG of the whole, byte for byte.
#include "runtime/svdag_forest.h"
#include "runtime/trees.h"
#include "support/dag_compare.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/morton_index.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace zvo
{

namespace
{

using test::device;

void expectTilesMakeTheWhole(const Scene& scene, std::uint32_t depth, std::uint32_t tile_depth, bool ranks)
{
    const GpuScene uploaded = uploadScene(device(), scene, false);
    const BuildOptions options = {Coverage::Thin, false, {}};
    const Grid grid = Grid::around(scene.bounds(), depth);
    BuildResult whole = buildOctree(device(), uploaded, grid, options);
    std::uint32_t top_nodes = 0;
    for (std::size_t level = 0; level < grid.nodeLevels() - tile_depth / 2; ++level)
    {
        top_nodes += whole.octree.levels[level].node_count;
    }
    const DeviceTree expected = std::move(compress(device(), std::move(whole.octree), {.ranks = ranks}).dag);

    SvdagForest forest(device(), grid, tile_depth);
    std::uint32_t tile_count = 0;
    for (std::uint32_t code = 0; code >> (3 * (depth - tile_depth)) == 0; ++code)
    {
        BuildResult built = buildOctree(device(), uploaded, {grid, tile_depth, test::mortonIndex(code)}, options);
        if (built.octree.node_count != 0)
        {
            forest.add(code, std::move(compress(device(), std::move(built.octree)).dag));
            ++tile_count;
        }
    }
    EXPECT_GT(tile_count, 1U);
    EXPECT_EQ(forest.topNodeCount(), top_nodes);
    DeviceTree dag = forest.finish(ranks);
    EXPECT_EQ(dag.lists.before.count() != 0, ranks && grid.nodeLevels() > 2);
    dag.voxel_count = expected.voxel_count; // which the forest does not count
    dag.lists.octree_node_count = expected.lists.octree_node_count;
    EXPECT_EQ(test::difference(device(), dag, expected), "");
}

TEST(SvdagForest, OfTilesIsTheDagOfTheWhole)
{
    const Scene scene = test::materialsScene(1.0F);
    expectTilesMakeTheWhole(scene, 6, 4, true);
    expectTilesMakeTheWhole(scene, 6, 4, false);
    expectTilesMakeTheWhole(scene, 7, 4, true); // the grid is an octant of the root
    expectTilesMakeTheWhole(scene, 7, 6, true);
}

// There are so many nodes that parts are merged on the way.
TEST(SvdagForest, MergesOnTheWay)
{
    expectTilesMakeTheWhole(test::sphereScene({0, 0, 0}, 1.0F, 64), 10, 8, true);
    expectTilesMakeTheWhole(test::randomTriangles(7, 300, 1.0F), 9, 6, true);
}

// Each tile is a single node, below several levels.
TEST(SvdagForest, OfTheSmallestTilesIsTheDagOfTheWhole)
{
    expectTilesMakeTheWhole(test::sphereScene({0, 0, 0}, 1.0F, 16), 5, 4, true);
}

TEST(SvdagForest, OfNothingIsEmpty)
{
    const DeviceTree dag = SvdagForest(device(), Grid{{}, 1.0F, 6}, 4).finish(true);
    EXPECT_EQ(dag.node_count, 0U);
}

} // namespace
} // namespace zvo
