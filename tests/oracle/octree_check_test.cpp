// SPDX-License-Identifier: MIT
#include "oracle/octree_check.h"

#include "oracle/test_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace zvo::oracle
{
namespace
{

std::vector<std::uint64_t> pickOctreeCodes(test::Random& random, std::uint32_t depth, std::size_t count)
{
    std::vector<std::uint64_t> codes;
    for (std::size_t i = 0; i < count; ++i)
        codes.push_back(static_cast<std::uint64_t>(test::pick(random, 0, (std::int64_t{1} << (3 * depth)) - 1)));
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    return codes;
}

TEST(OracleOctree, HandMadeOctreeExpands)
{
    // Depth 3, so two levels of nodes: voxels 0, 1, 32 and 63 of the first leaf, voxel 2 of the leaf in cell 5.
    const std::vector<gpu::Node> nodes{{0b100001, 1, 0, 3}, {0b11, 0, 0x80000001, 2}, {0b100, 4, 0, 5}};
    const std::vector<NodeRange> levels{{0, 1}, {1, 2}};
    const OctreeContents contents = checkOctree(nodes, levels, 3);
    EXPECT_EQ(contents.violations, std::vector<std::string>{});
    EXPECT_EQ(contents.codes, (std::vector<std::uint64_t>{0, 1, 32, 63, 5 * 64 + 2}));
}

TEST(OracleOctree, EmptyOctreeIsValid)
{
    const OctreeContents contents = checkOctree({}, {}, 5);
    EXPECT_TRUE(contents.violations.empty());
    EXPECT_TRUE(contents.codes.empty());
}

TEST(OracleOctree, ReferenceExpandsToItsVoxels)
{
    test::Random random(9);
    for (std::uint32_t depth = 1; depth <= 17; ++depth)
    {
        for (const std::size_t count : {1U, 27U, 2049U, 10201U})
        {
            const std::vector<std::uint64_t> codes = pickOctreeCodes(random, depth, count);
            const ReferenceOctree octree = referenceOctree(codes, depth);
            const OctreeContents contents = checkOctree(octree.nodes, octree.levels, depth);
            EXPECT_EQ(contents.violations, std::vector<std::string>{});
            EXPECT_EQ(contents.codes, codes);
        }
    }
}

TEST(OracleOctree, EveryChangedWordIsNoticed)
{
    test::Random random(10);
    const std::vector<std::uint64_t> codes = pickOctreeCodes(random, 5, 200);
    const ReferenceOctree octree = referenceOctree(codes, 5);
    for (std::size_t i = 0; i < octree.nodes.size(); ++i)
    {
        for (const auto word : {&gpu::Node::mask_lo, &gpu::Node::base_lo, &gpu::Node::mask_hi, &gpu::Node::base_hi})
        {
            std::vector<gpu::Node> nodes = octree.nodes;
            nodes[i].*word ^= 1;
            const OctreeContents contents = checkOctree(nodes, octree.levels, 5);
            // Adding or removing a voxel of the last leaf gives another valid octree.
            EXPECT_TRUE(!contents.violations.empty() || contents.codes != codes) << "node " << i;
        }
    }
}

TEST(OracleOctree, BrokenLevelsAreNoticed)
{
    test::Random random(11);
    const ReferenceOctree octree = referenceOctree(pickOctreeCodes(random, 5, 200), 5);
    const auto violations = [&](std::vector<NodeRange> levels)
    { return checkOctree(octree.nodes, levels, 5).violations.size(); };
    std::vector<NodeRange> levels = octree.levels;
    ASSERT_EQ(levels.size(), 3U);
    EXPECT_EQ(violations(levels), 0U);
    EXPECT_NE(violations({}), 0U);
    EXPECT_NE(violations({levels[0], levels[1]}), 0U);
    std::swap(levels[1], levels[2]);
    EXPECT_NE(violations(levels), 0U);
    levels = octree.levels;
    --levels[1].node_count;
    ++levels[2].node_count;
    --levels[2].first_node;
    EXPECT_NE(violations(levels), 0U);
    levels = octree.levels;
    levels[2].node_count += 1000;
    EXPECT_NE(violations(levels), 0U);
    EXPECT_NE(checkOctree({}, octree.levels, 5).violations.size(), 0U);
}

TEST(OracleOctree, EmptyNodesAndVoxelsOutsideOfTheGridAreNoticed)
{
    const std::vector<NodeRange> one_level{{0, 1}};
    EXPECT_EQ(checkOctree(std::vector<gpu::Node>{{0, 0, 0, 0}}, one_level, 2).violations,
              std::vector<std::string>{"node 0 (level 0) is empty"});
    EXPECT_EQ(checkOctree(std::vector<gpu::Node>{{1u << 8, 0, 0, 1}}, one_level, 1).violations,
              std::vector<std::string>{"a voxel lies outside of the grid"});
}

TEST(OracleOctree, ViolationsAreBounded)
{
    const std::vector<gpu::Node> nodes(65, gpu::Node{0xFFFFFFFF, 7, 0xFFFFFFFF, 7});
    const std::vector<NodeRange> levels{{0, 1}, {1, 64}};
    EXPECT_EQ(checkOctree(nodes, levels, 4).violations.size(), kViolationsMax);
}

} // namespace
} // namespace zvo::oracle
