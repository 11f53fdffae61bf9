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

std::vector<std::uint64_t> wordsOf(const vk::BufferOf<gpu::Node>& nodes)
{
    std::vector<std::uint64_t> words;
    for (const gpu::Node& node : device().download(nodes))
    {
        words.push_back(node.mask_lo | std::uint64_t{node.base_lo} << 32);
        words.push_back(node.mask_hi | std::uint64_t{node.base_hi} << 32);
    }
    return words;
}

TEST(TreeData, PoolsEndInZeros)
{
    for (const TreeSample& sample : treeSamples())
    {
        const DeviceTree uploaded = uploadTree(device(), sample.tree);
        if (uploaded.isDag())
        {
            const std::vector<std::uint64_t> words = wordsOf(uploaded.nodes);
            std::vector<gpu::uint> entries; // of 16 bits, as the samples are small
            for (std::uint64_t word = uploaded.nodeWords(); word < words.size(); ++word)
            {
                for (std::uint32_t i = 0; i < 4; ++i)
                {
                    entries.push_back(words[word] >> 16 * i & 0xFFFF);
                }
            }
            const std::size_t used = sample.tree.lists.size();
            ASSERT_LE(used, entries.size()) << sample.name;
            ASSERT_LE(entries.size(), used + 10) << sample.name;
            for (std::size_t i = 0; i < entries.size(); ++i)
            {
                const bool is_leaf = i >= sample.tree.long_entry_count;
                const gpu::uint number = i < used ? sample.tree.lists[i] : 0;
                EXPECT_EQ(entries[i], number + (i < used && is_leaf ? uploaded.innerCount() : 0)) << sample.name;
            }
        }
    }
}

TEST(TreeData, LeafGroupsTellTheFirstVoxelsOfLeafWords)
{
    for (const TreeSample& sample : treeSamples())
    {
        const DeviceTree uploaded = uploadTree(device(), sample.tree);
        const std::vector<std::uint64_t> words = wordsOf(uploaded.nodes);
        const std::vector<gpu::uvec2> groups = device().download(uploaded.leaf_groups);
        EXPECT_EQ(groups.empty(), uploaded.isDag() || uploaded.leaf_words == 0);
        for (std::uint32_t i = 0; i < uploaded.leaf_words; ++i)
        {
            const gpu::Node& leaf = sample.tree.nodes.at(uploaded.innerCount() + i);
            EXPECT_EQ(words.at(std::uint64_t{2} * uploaded.innerCount() + i), cellMask(leaf));
            const std::uint32_t word = 2 * uploaded.innerCount() + i;
            if (!uploaded.isDag() && word % 2 == 0)
            {
                const gpu::uvec2 group = groups.at(gpu::kFirstLeafGroup + word / 8);
                const std::array<gpu::uint, 4> before = {0, group.y & 255, group.y >> 8 & 511, group.y >> 17};
                EXPECT_EQ(group.x + before.at(word % 8 / 2), leaf.base_lo) << sample.name << " leaf " << i;
            }
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
