// SPDX-License-Identifier: MIT
// A DAG that is built tile by tile equals the DAG of the whole: nodes, lists, attributes, averages, emission.
#include "core/base/kernels.h"
#include "core/tree/device_tree.h"
#include "runtime/tiled_build.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/scenes.h"
#include "support/tree_samples.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace zvo
{

namespace
{

using test::device;

TreeData wholeDag(vk::HeadlessDevice& on, const GpuScene& scene, const Grid& grid, AttributeFormat attributes)
{
    BuildResult built = buildOctree(on, scene, grid, {Coverage::Thin, attributes != AttributeFormat::None, {}});
    DeviceTree dag = compress(on, std::move(built.octree)).dag;
    packTree(on, attributes, dag);
    return downloadTree(on, dag);
}

TEST(TiledBuild, IsTheWholeWhateverTheTiles)
{
    const Scene scene = test::materialsScene(1.0F);
    const GpuScene uploaded = uploadScene(device(), scene, true);
    for (const std::uint32_t depth : {6U, 7U})
    {
        const Grid grid = Grid::around(scene.bounds(), depth);
        for (const AttributeFormat attributes :
             {AttributeFormat::Bytes8, AttributeFormat::Blocks, AttributeFormat::None})
        {
            const TreeData expected = wholeDag(device(), uploaded, grid, attributes);
            ASSERT_GT(expected.voxel_count, 1000U);
            EXPECT_EQ(expected.emission.empty(), attributes == AttributeFormat::None);
            for (const std::uint32_t tile_depth : {4U, 6U, 12U})
            {
                if (attributes == AttributeFormat::None && tile_depth == 4)
                {
                    continue; // there are many tiles, so one case is enough
                }
                double last = -1;
                TiledOptions options = {Coverage::Thin, attributes, tile_depth,
                                        [&](double done)
                                        {
                                            EXPECT_GT(done, last);
                                            EXPECT_LT(done, 1.0);
                                            last = done;
                                        }};
                const TiledResult tiled = buildByTiles(device(), uploaded, grid, options);
                EXPECT_EQ(test::treeDifference(tiled.tree, expected), "");
                EXPECT_EQ(tiled.tile_count > 1, tile_depth < depth);
                EXPECT_EQ(last >= 0, tile_depth < depth);
            }
        }
    }
}

// Memory suffices only for a part of the grid, or a part of a part. Tiles are split until they fit.
TEST(TiledBuild, TakesSmallerTilesWhereMemoryIsShort)
{
    const Scene scene = test::sphereScene({0, 0, 0}, 1.0F, 48);
    const Grid grid = Grid::around(scene.bounds(), 9);
    const TreeData expected = wholeDag(device(), uploadScene(device(), scene, true), grid, AttributeFormat::Blocks);
    std::uint32_t tile_count = 1;
    for (const std::uint64_t budget : {14ULL << 20, 7ULL << 20})
    {
        vk::HeadlessOptions options = test::deviceOptions();
        options.memory_budget_bytes = budget;
        vk::HeadlessDevice small(options, zvoKernels());
        const GpuScene uploaded = uploadScene(small, scene, true);
        EXPECT_THROW(wholeDag(small, uploaded, grid, AttributeFormat::Blocks), Error);
        const TiledResult tiled = buildByTiles(small, uploaded, grid, {.attributes = AttributeFormat::Blocks});
        EXPECT_EQ(test::treeDifference(tiled.tree, expected), "");
        EXPECT_GT(tiled.tile_count, tile_count);
        EXPECT_LE(small.device().memory().peakBytes(), budget);
        tile_count = tiled.tile_count;
    }
}

TEST(TiledBuild, OfNothingIsEmpty)
{
    const GpuScene uploaded = uploadScene(device(), Scene{}, true);
    const TiledResult tiled =
        buildByTiles(device(), uploaded, {glm::vec3(0.0F), 1.0F, 8}, {Coverage::Thin, AttributeFormat::Bytes8, 6});
    EXPECT_EQ(tiled.tile_count, 0U);
    EXPECT_EQ(tiled.tree.voxel_count, 0U);
    EXPECT_TRUE(tiled.tree.nodes.empty());
}

TEST(TiledBuild, NeedsTilesThatAreNodes)
{
    const GpuScene uploaded = uploadScene(device(), Scene{}, false);
    EXPECT_THROW(buildByTiles(device(), uploaded, Grid{}, {Coverage::Thin, AttributeFormat::None, 5}), Error);
    EXPECT_THROW(buildByTiles(device(), uploaded, Grid{}, {Coverage::Thin, AttributeFormat::None, 2}), Error);
}

} // namespace
} // namespace zvo
