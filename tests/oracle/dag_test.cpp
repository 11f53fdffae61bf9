// SPDX-License-Identifier: MIT
#include "oracle/dag.h"

#include "oracle/test_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace zvo::oracle
{
namespace
{

DagContents contentsOf(const ReferenceDag& dag)
{
    return expandDag(dag.pool, dag.levels, dag.entry_count, dag.long_entry_count, dag.before, dag.voxels_before_leaf,
                     dag.entries_per_word);
}

std::vector<std::uint32_t> wordsOf(const std::vector<gpu::Node>& nodes)
{
    std::vector<std::uint32_t> words;
    for (const gpu::Node& node : nodes)
        words.insert(words.end(), {node.mask_lo, node.base_lo, node.mask_hi, node.base_hi});
    return words;
}

std::vector<std::uint64_t> codesOf(const std::vector<DagNode>& places)
{
    std::vector<std::uint64_t> codes;
    for (const DagNode& place : places)
        codes.push_back(place.code);
    return codes;
}

// Random voxels, each in two neighbouring leaves, so that some leaves are equal.
std::vector<std::uint64_t> pickCodes(test::Random& random, std::uint32_t depth, std::size_t count)
{
    const std::uint64_t end = std::uint64_t{1} << (3 * depth);
    std::vector<std::uint64_t> codes;
    for (std::size_t i = 0; i < count; ++i)
    {
        const auto code = static_cast<std::uint64_t>(test::pick(random, 0, static_cast<std::int64_t>(end) - 1));
        codes.push_back(code);
        codes.push_back((code ^ 64) % end);
    }
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    return codes;
}

// Three levels. Leaves A (voxels 0 and 2) and B (voxel 32); P with A in cell 1 and B in cell 40; R with B in cell 0;
// the root with P in cells 0 and 5, and R in cell 63.
struct HandMade
{
    std::vector<gpu::Node> nodes{{0b100001, 1, 0x80000000, 3},
                                 {0b10, 4, 256, 5},
                                 {0b10, 6, 256, 7},
                                 {1, 8, 0, 9},
                                 {0b101, 0, 0, 2},
                                 {0, 2, 1, 2},
                                 {0b101, 3, 0, 5},
                                 {0, 5, 1, 5},
                                 {0, 6, 1, 6}};
    std::vector<NodeRange> levels{{0, 1}, {1, 3}, {4, 5}};
};

TEST(OracleDag, HandMadeOctreeIsCompressed)
{
    const HandMade octree;
    ASSERT_EQ(checkOctree(octree.nodes, octree.levels, 6).violations, std::vector<std::string>{});
    const ReferenceDag dag = referenceDag(octree.nodes, octree.levels);
    const std::uint32_t list = 0x80000000;
    EXPECT_EQ(wordsOf(dag.pool), (std::vector<std::uint32_t>{
                                     0b100001, list | 40, 0x80000000, list | 42, // root
                                     0b10,     list | 43, 256,        list | 44, // P
                                     1,        list | 45, 0,          list | 46, // R
                                     0b101,    0,         0,          2,         // A
                                     0,        0,         1,          0,         // B
                                     0x10001,  0x30002,   0x40004,    0,         // four entries a word
                                 }));
    EXPECT_EQ(dag.entries_per_word, 4);
    ASSERT_EQ(dag.levels.size(), 3);
    EXPECT_EQ(dag.levels[1].first_node, 1);
    EXPECT_EQ(dag.levels[1].node_count, 2);
    EXPECT_EQ(dag.levels[2].first_node, 3);
    EXPECT_EQ(dag.levels[2].node_count, 2);
    EXPECT_EQ(dag.node_count, 5);
    EXPECT_EQ(dag.octree_node_count, 9);
    EXPECT_EQ(dag.entry_count, 6);
    EXPECT_EQ(dag.long_entry_count, 3);
    ASSERT_EQ(dag.before.size(), 3);
    for (std::uint32_t i = 0; i < 3; ++i)
    {
        EXPECT_EQ(dag.before[i].voxels, 3 * i);
        EXPECT_EQ(dag.before[i].nodes, 3 * i);
    }
    EXPECT_EQ(dag.voxels_before_leaf, (std::vector<std::uint32_t>{2 << 16, 0}));
    EXPECT_EQ(dag.depth_first, (std::vector<std::uint32_t>{0, 1, 4, 5, 2, 6, 7, 3, 8}));
}

TEST(OracleDag, HandMadeListsHaveFewerEntriesAWordIfAsked)
{
    const HandMade octree;
    const std::uint32_t list = 0x80000000;
    const ReferenceDag three = referenceDag(octree.nodes, octree.levels, 3);
    const std::vector<std::uint32_t> words = wordsOf(three.pool);
    EXPECT_EQ(words[1], list | 30);
    // 1, 1, 2 and 3, 4, 4: 21 bits each.
    EXPECT_EQ((std::vector(words.begin() + 20, words.end())),
              (std::vector<std::uint32_t>{1 | 1 << 21, 2 << 10, 3 | 4 << 21, 4 << 10}));
    const ReferenceDag two = referenceDag(octree.nodes, octree.levels, 2);
    const std::vector<std::uint32_t> wide = wordsOf(two.pool);
    EXPECT_EQ(wide[1], list | 20);
    EXPECT_EQ((std::vector(wide.begin() + 20, wide.end())), (std::vector<std::uint32_t>{1, 1, 2, 3, 4, 4, 0, 0}));
    for (const ReferenceDag& dag : {three, two})
    {
        const DagContents contents = contentsOf(dag);
        EXPECT_EQ(contents.violations, std::vector<std::string>{});
        EXPECT_EQ(contents.voxels, contentsOf(referenceDag(octree.nodes, octree.levels)).voxels);
    }
}

TEST(OracleDag, HandMadeDagExpands)
{
    const HandMade octree;
    const DagContents contents = contentsOf(referenceDag(octree.nodes, octree.levels));
    const std::uint64_t p = 5 << 12;
    const std::uint64_t r = 63 << 12;
    EXPECT_EQ(contents.violations, std::vector<std::string>{});
    EXPECT_EQ(
        contents.voxels,
        (std::vector<DagNode>{
            {3, 64, 0}, {3, 66, 1}, {3, 2592, 2}, {3, p + 64, 3}, {3, p + 66, 4}, {3, p + 2592, 5}, {3, r + 32, 6}}));
    EXPECT_EQ(contents.nodes, (std::vector<DagNode>{{0, 0, 0},
                                                    {1, 0, 1},
                                                    {2, 1, 2},
                                                    {2, 40, 3},
                                                    {1, 5, 4},
                                                    {2, 5 << 6 | 1, 5},
                                                    {2, 5 << 6 | 40, 6},
                                                    {1, 63, 7},
                                                    {2, 63 << 6, 8}}));
}

TEST(OracleDag, EmptyOctreeGivesAnEmptyDag)
{
    const ReferenceDag dag = referenceDag({}, {});
    EXPECT_TRUE(dag.pool.empty());
    EXPECT_EQ(dag.octree_node_count, 0);
    const DagContents contents = contentsOf(dag);
    EXPECT_EQ(contents.violations, std::vector<std::string>{});
    EXPECT_TRUE(contents.voxels.empty());
}

TEST(OracleDag, FullGridHasOneNodeALevel)
{
    std::vector<std::uint64_t> codes(1U << 15);
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = i;
    const ReferenceOctree octree = referenceOctree(codes, 5);
    const ReferenceDag dag = referenceDag(octree.nodes, octree.levels);
    EXPECT_EQ(dag.node_count, 3);
    EXPECT_EQ(dag.octree_node_count, 1 + 8 + 512);
    EXPECT_EQ(dag.entry_count, 8 + 64);
    EXPECT_EQ(codesOf(contentsOf(dag).voxels), codes);
}

TEST(OracleDag, ExpandsToTheOctreeAtEveryDepth)
{
    test::Random random(21);
    for (std::uint32_t depth = 1; depth <= 17; ++depth)
    {
        for (const std::size_t count : {1U, 27U, 2049U})
        {
            const std::vector<std::uint64_t> codes = pickCodes(random, depth, count);
            const ReferenceOctree octree = referenceOctree(codes, depth);
            const ReferenceDag dag = referenceDag(octree.nodes, octree.levels);
            const DagContents contents = contentsOf(dag);
            EXPECT_EQ(contents.violations, std::vector<std::string>{});
            EXPECT_EQ(codesOf(contents.voxels), codes);
            for (std::size_t i = 0; i < contents.voxels.size(); ++i)
                ASSERT_EQ(contents.voxels[i].rank, i);
            ASSERT_EQ(contents.nodes.size(), octree.nodes.size());
            ASSERT_EQ(dag.depth_first.size(), octree.nodes.size());
            for (std::size_t i = 0; i < contents.nodes.size(); ++i)
            {
                ASSERT_EQ(contents.nodes[i].rank, i);
                const NodeRange& range = octree.levels[contents.nodes[i].level];
                ASSERT_LT(dag.depth_first[i] - range.first_node, range.node_count);
            }
        }
    }
}

TEST(OracleDag, EveryChangedWordIsNoticed)
{
    test::Random random(22);
    const ReferenceOctree octree = referenceOctree(pickCodes(random, 6, 100), 6);
    const ReferenceDag dag = referenceDag(octree.nodes, octree.levels);
    const DagContents expected = contentsOf(dag);
    const auto expectNoticed = [&](const ReferenceDag& changed)
    {
        const DagContents contents = contentsOf(changed);
        EXPECT_TRUE(!contents.violations.empty() || contents.voxels != expected.voxels ||
                    contents.nodes != expected.nodes);
    };
    for (std::size_t i = 0; i < dag.pool.size(); ++i)
    {
        for (std::uint32_t gpu::Node::*word :
             {&gpu::Node::mask_lo, &gpu::Node::base_lo, &gpu::Node::mask_hi, &gpu::Node::base_hi})
        {
            for (const std::uint32_t change : {1U, 4U, 0x80000000U})
            {
                ReferenceDag changed = dag;
                changed.pool[i].*word ^= change;
                expectNoticed(changed);
            }
        }
    }
    for (std::size_t i = 0; i < dag.before.size(); ++i)
    {
        ReferenceDag changed = dag;
        ++changed.before[i].voxels;
        expectNoticed(changed);
        changed = dag;
        ++changed.before[i].nodes;
        expectNoticed(changed);
    }
    for (std::size_t i = 0; i < (dag.entry_count - dag.long_entry_count); ++i)
    {
        ReferenceDag changed = dag;
        changed.voxels_before_leaf[i / 2] ^= 1U << (16 * (i % 2));
        expectNoticed(changed);
    }
}

} // namespace
} // namespace zvo::oracle
