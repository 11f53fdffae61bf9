// SPDX-License-Identifier: MIT
#include "core/tree/tree_data.h"

#include "core/file/tree_check.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/tree_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace zvo::test
{
namespace
{

TEST(TreeData, ComesBackFromTheDeviceAsItWas)
{
    for (const TreeSample& sample : treeSamples())
    {
        const DeviceTree uploaded = uploadTree(device(), sample.tree);
        const TreeData back = downloadTree(device(), uploaded);
        EXPECT_EQ(treeDifference(back, sample.tree), "") << sample.name;
        EXPECT_EQ(back.geometryBytes(), uploaded.geometryBytes());
    }
}

TEST(TreeData, PoolsEndInZeros)
{
    for (const TreeSample& sample : treeSamples())
    {
        const DeviceTree uploaded = uploadTree(device(), sample.tree);
        if (uploaded.isDag())
        {
            std::vector<gpu::uint> entries; // of 16 bits, as the samples are small
            for (const gpu::Node& node : device().download(uploaded.nodes, sample.tree.nodes.size()))
            {
                for (const gpu::uint word : {node.mask_lo, node.base_lo, node.mask_hi, node.base_hi})
                {
                    entries.insert(entries.end(), {word & 0xFFFF, word >> 16});
                }
            }
            const std::size_t used = sample.tree.lists.size();
            ASSERT_EQ(entries.size(), (used + 7) / 8 * 8) << sample.name;
            EXPECT_TRUE(std::equal(sample.tree.lists.begin(), sample.tree.lists.end(), entries.begin()));
            EXPECT_TRUE(std::all_of(entries.begin() + static_cast<std::ptrdiff_t>(used), entries.end(),
                                    [](gpu::uint entry) { return entry == 0; }));
        }
    }
}

TEST(TreeData, OfABuiltOctreeIsSound)
{
    const Scene scene = materialsScene(1.0F);
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    for (const std::uint32_t depth : {1U, 4U, 7U})
    {
        const Grid grid = Grid::around(scene.bounds(), depth);
        const BuildResult built = buildOctree(device(), gpu_scene, grid, {});
        const TreeData tree = downloadTree(device(), built.octree);
        EXPECT_EQ(checkTree(tree), std::nullopt);
        EXPECT_FALSE(tree.emission.empty());
        std::vector<std::uint64_t> codes;
        forEachVoxel(tree, [&codes](std::uint64_t code) { codes.push_back(code); });
        EXPECT_EQ(codes, voxelCodes(device(), built.octree));
        const TreeData dag = dagOf(tree);
        EXPECT_EQ(checkTree(dag), std::nullopt);
        const DeviceTree again = uploadTree(device(), tree);
        EXPECT_EQ(octreeSha256(device(), again), octreeSha256(device(), built.octree));
    }
}

TEST(TreeData, VoxelsOfADagAreThoseOfTheOctreeInTheirOrder)
{
    for (const TreeSample& sample : treeSamples())
    {
        if (sample.tree.structure == TreeStructure::Svo)
        {
            std::vector<std::uint64_t> codes;
            std::vector<std::uint64_t> of_dag;
            forEachVoxel(sample.tree, [&](std::uint64_t code) { codes.push_back(code); });
            forEachVoxel(dagOf(sample.tree), [&](std::uint64_t code) { of_dag.push_back(code); });
            EXPECT_EQ(codes.size(), sample.tree.voxel_count);
            EXPECT_TRUE(std::is_sorted(codes.begin(), codes.end()));
            EXPECT_EQ(of_dag, codes) << sample.name;
        }
    }
}

TEST(TreeData, BoxEnclosesExactlyTheVoxels)
{
    for (const TreeSample& sample : treeSamples())
    {
        CellBox expected;
        forEachVoxel(sample.tree,
                     [&expected](std::uint64_t code)
                     {
                         glm::uvec3 cell(0U);
                         for (std::uint32_t bit = 0; bit < 20; ++bit)
                         {
                             for (int axis = 0; axis < 3; ++axis)
                             {
                                 cell[axis] |= static_cast<std::uint32_t>(code >> (3 * bit + axis) & 1) << bit;
                             }
                         }
                         expected.min = glm::min(expected.min, cell);
                         expected.max = glm::max(expected.max, cell + 1U);
                     });
        const std::optional<CellBox> box = voxelBox(sample.tree);
        ASSERT_EQ(box.has_value(), sample.tree.voxel_count != 0);
        if (box)
        {
            EXPECT_EQ(box->min, expected.min) << sample.name;
            EXPECT_EQ(box->max, expected.max) << sample.name;
        }
    }
}

} // namespace
} // namespace zvo::test
