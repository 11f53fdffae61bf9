// SPDX-License-Identifier: MIT
// Tiles have the same voxels and attributes as the whole grid, bit for bit.
#include "core/scene/points.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/morton_index.h"
#include "support/param_names.h"
#include "support/same_bytes.h"
#include "support/scenes.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

/// The voxels of an octree and their attributes, in Morton order.
struct Contents
{
    std::vector<std::uint64_t> codes;
    std::vector<gpu::Attribute> attributes;
    std::vector<gpu::uint> emission;
};

Contents contentsOf(const DeviceTree& octree)
{
    if (octree.node_count == 0)
    {
        return {};
    }
    return {voxelCodes(device(), octree), device().download(octree.voxel_attributes),
            device().download(octree.emission)};
}

template <typename T> void append(std::vector<T>& all, const std::vector<T>& more)
{
    all.insert(all.end(), more.begin(), more.end());
}

void expectTilesMakeTheWhole(const Scene& scene, const Grid& grid, std::uint32_t tile_depth, Coverage coverage)
{
    const GpuScene uploaded = uploadScene(device(), scene, true);
    const BuildOptions options = {coverage, true, {}};
    const BuildResult whole = buildOctree(device(), uploaded, grid, options);
    const Contents expected = contentsOf(whole.octree);
    ASSERT_GT(expected.codes.size(), 100U);

    Contents tiles;
    std::size_t occupied = 0;
    for (std::uint32_t code = 0; code >> (3 * (grid.depth - tile_depth)) == 0; ++code)
    {
        const BuildResult built = buildOctree(device(), uploaded, {grid, tile_depth, test::mortonIndex(code)}, options);
        EXPECT_EQ(built.dropped, whole.dropped);
        const Contents contents = contentsOf(built.octree);
        for (const std::uint64_t voxel : contents.codes)
        {
            ASSERT_EQ(voxel >> (3 * tile_depth), code) << "a voxel outside of its tile";
        }
        occupied += contents.codes.empty() ? 0 : 1;
        append(tiles.codes, contents.codes);
        append(tiles.attributes, contents.attributes);
        append(tiles.emission, contents.emission);
    }
    EXPECT_GT(occupied, 1U);
    EXPECT_EQ(tiles.codes, expected.codes);
    EXPECT_TRUE(test::sameBytes(tiles.attributes, expected.attributes));
    EXPECT_TRUE(test::sameBytes(tiles.emission, expected.emission));
}

using Tiles = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, Tiles, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

TEST_P(Tiles, OfEveryMaterialMakeTheWhole)
{
    const Scene scene = test::materialsScene(1.0F);
    for (const std::uint32_t tile_depth : {4U, 5U})
    {
        expectTilesMakeTheWhole(scene, Grid::around(scene.bounds(), 6), tile_depth, GetParam());
    }
}

// Large triangles, partly beyond the grid, and wide keys.
TEST_P(Tiles, OfLargeTrianglesMakeTheWhole)
{
    const Scene scene = test::materialsScene(100.0F, 3);
    const Grid grid = {glm::vec3(-10.0F, 5.0F, 0.25F), 90.0F / 1024, 10};
    expectTilesMakeTheWhole(scene, grid, 9, GetParam());
}

// Triangles without area have no major axis. The axis taken depends on the part of their boxes that a tile has.
TEST_P(Tiles, OfSegmentsAndPointsMakeTheWhole)
{
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 60; ++i)
    {
        const glm::vec3 a(i * 7 % 61, i * 11 % 59, i * 13 % 53);
        const glm::vec3 b(i * 17 % 63, i * 5 % 57, i % 3 == 0 ? a.z : static_cast<float>(i * 23 % 47));
        corners.insert(corners.end(), {a, i % 5 == 0 ? a : b, 0.5F * (a + b)});
        corners.insert(corners.end(), {a, a + glm::vec3(0.4F, 0.0F, 0.1F), b}); // some have area, for both coverages
    }
    expectTilesMakeTheWhole(test::triangleSoup(corners), {glm::vec3(-1.0F), 1.0F, 6}, 4, GetParam());
}

TEST_P(Tiles, OfCloudsOfPointsMakeTheWhole)
{
    Scene scene = test::randomPoints(3, 3000, 64);
    widenPoints(scene, 2);
    expectTilesMakeTheWhole(scene, {glm::vec3(0.0F), 1.0F, 6}, 4, GetParam());
}

// The grid is an octant of the root node, and tiles are not whole nodes.
TEST_P(Tiles, OfAnOddDepthMakeTheWhole)
{
    const Scene scene = test::materialsScene(1.0F);
    expectTilesMakeTheWhole(scene, Grid::around(scene.bounds(), 7), 5, GetParam());
}

TEST(Tile, OutsideOfTheGridIsRefused)
{
    const Scene scene = test::materialsScene(1.0F);
    const GpuScene uploaded = uploadScene(device(), scene, false);
    const Grid grid = Grid::around(scene.bounds(), 6);
    const BuildOptions options = {Coverage::Thin, false, {}};
    EXPECT_THROW(buildOctree(device(), uploaded, {grid, 5, {2, 0, 0}}, options), Error);
    EXPECT_THROW(buildOctree(device(), uploaded, {grid, 7, {0, 0, 0}}, options), Error);
}

} // namespace
} // namespace zvo
