// SPDX-License-Identifier: MIT
#include "core/file/tree_stats.h"

#include "support/tree_samples.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

namespace zvo::test
{
namespace
{

// The binary octree of a set of voxels, and its different subtrees, made with maps.
struct BinaryTrees
{
    std::uint64_t node_count = 0;
    std::uint64_t unique_count = 0;
};

BinaryTrees binaryTrees(const TreeData& tree)
{
    std::map<std::uint64_t, std::uint64_t> level; // a cell's code -> what is below it
    forEachVoxel(tree, [&level](std::uint64_t code) { level[code] = 0; });
    BinaryTrees trees;
    for (std::uint32_t i = 0; i < tree.grid.depth; ++i)
    {
        std::map<std::uint64_t, std::vector<std::uint64_t>> parents;
        for (const auto& [code, kind] : level)
        {
            parents[code >> 3].resize(8, UINT64_MAX);
            parents[code >> 3][code & 7] = kind;
        }
        std::map<std::vector<std::uint64_t>, std::uint64_t> kinds;
        level.clear();
        for (const auto& [code, children] : parents)
        {
            level[code] = kinds.emplace(children, kinds.size()).first->second;
        }
        trees.node_count += parents.size();
        trees.unique_count += kinds.size();
    }
    return trees;
}

TEST(TreeStats, CountNodesOfBinaryTreesOfTheSameVoxels)
{
    for (const TreeSample& sample : treeSamples())
    {
        const TreeStats stats = treeStats(sample.tree);
        const BinaryTrees expected = binaryTrees(sample.tree);
        EXPECT_EQ(stats.binary_node_count, expected.node_count) << sample.name;
        EXPECT_EQ(stats.binary_unique_count, expected.unique_count) << sample.name;
        EXPECT_EQ(stats.slidesOctreeBytes(), 36 * expected.node_count) << sample.name;
        EXPECT_EQ(stats.slidesDagBytes(), 68 * expected.unique_count) << sample.name;
    }
}

TEST(TreeStats, UniqueNodesAreThoseThatADagHas)
{
    for (const TreeSample& sample : treeSamples())
    {
        const TreeData dag = sample.tree.structure == TreeStructure::Svo ? dagOf(sample.tree) : sample.tree;
        std::vector<std::uint64_t> expected;
        for (const DeviceTree::Level& level : dag.levels)
        {
            expected.push_back(level.node_count);
        }
        EXPECT_EQ(treeStats(sample.tree).unique_per_level, expected) << sample.name;
    }
}

TEST(TreeStats, OfAFullGridAreKnown)
{
    std::vector<std::uint64_t> codes(1 << 12);
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        codes[i] = i;
    }
    const TreeStats stats = treeStats(octreeOf(codes, 4));
    EXPECT_EQ(stats.binary_node_count, 1U + 8 + 64 + 512);
    EXPECT_EQ(stats.binary_unique_count, 4U); // one in each level
    EXPECT_EQ(stats.unique_per_level, (std::vector<std::uint64_t>{1, 1}));
}

} // namespace
} // namespace zvo::test
