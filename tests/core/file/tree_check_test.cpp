// SPDX-License-Identifier: MIT
// Faults that checkTree finds, each alone in an otherwise valid tree, with its message.
#include "core/file/tree_check.h"

#include "support/tree_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <ostream>

namespace zvo::test
{
namespace
{

TEST(CheckTree, AcceptsWhatIsSound)
{
    for (const TreeSample& sample : treeSamples())
    {
        EXPECT_EQ(checkTree(sample.tree), std::nullopt) << sample.name;
    }
}

struct TreeFault
{
    const char* name;
    bool dag;
    std::function<void(TreeData&)> break_tree;
    const char* words;
};

void PrintTo(const TreeFault& fault, std::ostream* stream)
{
    *stream << fault.name;
}

gpu::Node& leaf(TreeData& tree, std::uint32_t number)
{
    return tree.nodes[tree.levels.back().first_node + number];
}

// A fault of the tree with packed attributes.
std::function<void(TreeData&)> packed(AttributeFormat format, const std::function<void(TreeData&)>& break_tree)
{
    return [=](TreeData& tree)
    {
        tree = packedTree(tree, format);
        break_tree(tree);
    };
}

const std::vector<TreeFault>& treeFaults()
{
    constexpr bool kOctree = false;
    constexpr bool kDag = true;
    static const std::vector<TreeFault> faults = {
        {"Structure", kOctree, [](auto& t) { t.structure = static_cast<TreeStructure>(7); }, "neither an octree nor"},
        {"ListsInOctree", kOctree, [](auto& t) { t.lists.push_back(0); }, "an octree with what only a DAG has"},
        {"OctreeNodes", kOctree, [](auto& t) { ++t.octree_node_count; }, "an octree with what only a DAG has"},
        {"Depth", kOctree, [](auto& t) { t.grid.depth = 18; }, "depth 18"},
        {"LevelMissing", kOctree, [](auto& t) { t.levels.pop_back(); }, "2 levels of nodes where"},
        {"LevelEmpty", kOctree, [](auto& t) { t.levels[1].node_count = 0; }, "level 1 has 0 nodes"},
        {"TwoRoots", kOctree, [](auto& t) { t.levels[0].node_count = 2; }, "level 0 has 2 nodes"},
        {"LevelElsewhere", kOctree, [](auto& t) { t.levels[2].first_node -= 1; }, "level 2 starts at node"},
        {"LevelTooLong", kOctree, [](auto& t) { t.levels[2].node_count += 1; }, "the levels have"},
        {"LevelOverflows", kOctree, [](auto& t) { t.levels[2].node_count = UINT32_MAX; }, "the levels have"},
        {"NodeWithoutChildren", kOctree, [](auto& t) { leaf(t, 3) = {}; }, "has no children"},
        {"RootOutside", kOctree, [](auto& t) { t.nodes[0].mask_lo |= 0x100U; }, "outside of the grid"},
        {"RootOutsideAbove", kDag, [](auto& t) { t.nodes[0].mask_hi = 1; }, "outside of the grid"},
        {"ChildUpward", kOctree, [](auto& t) { t.nodes[1].base_lo = 0; }, "node 1 of level 1 names 0"},
        {"ChildPastTheEnd", kOctree, [](auto& t) { t.nodes[1].base_hi = 0x7fffffffU; }, "node 1 of level 1 names"},
        {"ChildOfUnusedHalf", kOctree, [](auto& t) { t.nodes[0].base_hi += 1; }, "node 0 of level 0 names"},
        {"ChildInAList", kOctree, [](auto& t) { t.nodes[0].base_lo |= gpu::kChildList; }, "node 0 of level 0 names"},
        {"VoxelNumber", kOctree, [](auto& t) { leaf(t, 5).base_lo += 1; }, "as its first voxels"},
        {"OneVoxelLess", kOctree, [](auto& t) { --t.voxel_count; }, "voxels in all, where there are"},
        {"OneVoxelMore", kOctree, [](auto& t) { ++t.voxel_count; }, "voxels in all, where there are"},
        {"NodeNobodyNames", kOctree,
         [](auto& t)
         {
             t.nodes.push_back({1, t.voxel_count, 0, t.voxel_count + 1});
             ++t.levels[2].node_count;
             ++t.octree_node_count;
         },
         "children in all, where there are"},

        {"ListElsewhere", kDag, [](auto& t) { t.nodes[1].base_lo += 1; }, "has its lists at"},
        {"ListOutside", kDag, [](auto& t) { t.nodes[0].base_hi = UINT32_MAX; }, "has its lists at"},
        {"DirectChildren", kDag, [](auto& t) { t.nodes[0].base_lo &= ~gpu::kChildList; }, "has its lists at"},
        {"ListsTooShort", kDag, [](auto& t) { t.lists.pop_back(); }, "ends behind all lists"},
        {"ListsTooLong", kDag, [](auto& t) { t.lists.push_back(t.lists.back()); }, "entries of lists, but there are"},
        {"EntryUpward", kDag, [](auto& t) { t.lists[0] = 0; },
         "entry 0 of the lists names node 0, which is not in level 1"},
        {"EntryInItsOwnLevel", kDag, [](auto& t) { t.lists.back() = t.levels[1].first_node; },
         "which is not in level 2"},
        {"EntryPastTheEnd", kDag, [](auto& t) { t.lists.back() = static_cast<gpu::uint>(t.nodes.size()); },
         "which is not in level 2"},
        {"EntryHuge", kDag, [](auto& t) { t.lists.back() = UINT32_MAX; }, "which is not in level 2"},
        {"EntryTooEarly", kDag, [](auto& t) { t.lists[0] = t.levels[1].first_node + 1; }, "before node 1 was named"},
        {"NodeNobodyListed", kDag,
         [](auto& t)
         {
             for (gpu::uint& entry : t.lists)
             {
                 const std::uint32_t last = static_cast<std::uint32_t>(t.nodes.size()) - 1;
                 entry -= entry == last ? 1 : 0;
             }
         },
         "nothing leads to node"},
        {"LongEntries", kDag, [](auto& t) { ++t.long_entry_count; }, "are said to be long"},
        {"LeafNumbers", kDag, [](auto& t) { leaf(t, 0).base_lo = 1; }, "numbers its voxels from 1"},
        {"LeafNumbersAbove", kDag, [](auto& t) { leaf(t, 0).base_hi += 1; }, "numbers its voxels from 0"},
        {"BeforeVoxels", kDag, [](auto& t) { ++t.before.back().voxels; }, "counts beside entry"},
        {"BeforeNodes", kDag, [](auto& t) { --t.before[1].nodes; }, "counts beside entry 1 "},
        {"BeforeMissing", kDag, [](auto& t) { t.before.pop_back(); }, "counts beside the lists, where there must be"},
        {"VoxelsBeforeLeaf", kDag, [](auto& t) { t.voxels_before_leaf[0] += 1U << 16; }, "counts beside entry"},
        {"VoxelsBeforeLeafMissing", kDag, [](auto& t) { t.voxels_before_leaf.pop_back(); },
         "counts beside the lists, where there must be"},
        {"DagVoxels", kDag, [](auto& t) { --t.voxel_count; }, "octree nodes, but"},
        {"DagOctreeNodes", kDag, [](auto& t) { ++t.octree_node_count; }, "octree nodes, but"},

        {"VoxelAttributeMissing", kOctree, [](auto& t) { t.voxel_attributes.pop_back(); }, "there are attributes of"},
        {"NodeAttributeMissing", kDag, [](auto& t) { t.node_attributes.pop_back(); }, "there are attributes of"},
        {"NodeAttributesAlone", kOctree, [](auto& t) { t.voxel_attributes.clear(); }, "there are attributes of 0"},
        {"VoxelFlags", kOctree, [](auto& t) { t.voxel_attributes[3].color |= 2U << 24; }, "attribute 3 of the voxels"},
        {"NodeFlags", kDag, [](auto& t) { t.node_attributes[2].color |= 0x80U << 24; }, "attribute 2 of the nodes"},
        {"FormatsTwo", kOctree, [](auto& t) { t.packed = packedTree(t, AttributeFormat::Bytes4).packed; },
         "in two formats"},
        {"FormatUnknown", kOctree, [](auto& t) { t.packed.format = static_cast<AttributeFormat>(9); },
         "unknown format"},
        {"WordsWithoutFormat", kOctree, [](auto& t) { t.packed.nodes.push_back(0); }, "0 and 1 words"},
        {"PackedVoxelMissing", kDag, packed(AttributeFormat::Bytes4, [](auto& t) { t.packed.voxels.pop_back(); }),
         "packed attributes of voxels and nodes take"},
        {"PackedNodeTooMany", kOctree, packed(AttributeFormat::Bytes4, [](auto& t) { t.packed.nodes.push_back(0); }),
         "packed attributes of voxels and nodes take"},
        {"PackedNormalX", kOctree, packed(AttributeFormat::Bytes4, [](auto& t) { t.packed.voxels[7] = 0x00800000U; }),
         "attribute 7 of the voxels has a normal outside"},
        {"PackedNormalY", kDag, packed(AttributeFormat::Bytes4, [](auto& t) { t.packed.nodes[2] = 0x80000000U; }),
         "attribute 2 of the nodes has a normal outside"},
        {"BlockMissing", kDag,
         packed(AttributeFormat::Blocks, [](auto& t) { t.packed.voxels.resize(t.packed.voxels.size() - 6); }),
         "packed attributes of voxels and nodes take"},
        {"BlockCut", kOctree, packed(AttributeFormat::Blocks, [](auto& t) { t.packed.voxels.pop_back(); }),
         "packed attributes of voxels and nodes take"},
        {"BlockScale", kDag, packed(AttributeFormat::Blocks, [](auto& t) { t.packed.voxels[6 * 3 + 2] |= 127U << 21; }),
         "block 3 of the voxels has a scale outside"},
        {"BlockNodes", kOctree, packed(AttributeFormat::Blocks, [](auto& t) { t.packed.nodes[4] = 0x80000000U; }),
         "attribute 4 of the nodes has a normal outside"},
        {"EmissionScaleZero", kOctree, [](auto& t) { t.emission_scale = 0; }, "scale of emission"},
        {"EmissionScaleInfinite", kOctree, [](auto& t) { t.emission_scale = std::numeric_limits<float>::infinity(); },
         "scale of emission"},
        {"EmissiveByAttribute", kOctree,
         [](auto& t)
         {
             for (gpu::Attribute& attribute : t.voxel_attributes)
             {
                 attribute.color |= gpu::kAttributeEmissive << 24;
             }
         },
         "emits by its attribute alone"},
        {"EmissiveByTable", kDag, [](auto& t) { t.emission_words[0].x = UINT32_MAX; }, "by its bit in the emission"},
        {"EmissionRank", kOctree, [](auto& t) { ++t.emission_words[1].y; }, "word 1 of the emission table counts"},
        {"EmissionWordMissing", kOctree, [](auto& t) { t.emission_words.pop_back(); }, "words that tell what emits"},
        {"EmissionBitsBehind", kDag, [](auto& t) { t.emission_words.back().x |= 1U << 31; }, "behind the last voxel"},
        {"EmissionMissing", kOctree, [](auto& t) { t.emission.pop_back(); }, "emissions"},
        {"EmissionTooMuch", kDag, [](auto& t) { t.emission.push_back(0); }, "emissions"},
    };
    return faults;
}

using CheckTreeFault = testing::TestWithParam<TreeFault>;

INSTANTIATE_TEST_SUITE_P(Tree, CheckTreeFault, testing::ValuesIn(treeFaults()),
                         [](const auto& fault) { return std::string(fault.param.name); });

// 291 random voxels in a grid of depth 5: three levels, an odd number of entries beside leaves.
TreeData soundTree(bool dag)
{
    return treeSample(dag ? "random_5_with_attributes_dag" : "random_5_with_attributes");
}

TEST_P(CheckTreeFault, IsFound)
{
    TreeData tree = soundTree(GetParam().dag);
    ASSERT_NE(tree.voxel_count % 32, 0U);
    GetParam().break_tree(tree);
    const std::optional<std::string> fault = checkTree(tree);
    ASSERT_TRUE(fault.has_value());
    EXPECT_NE(fault->find(GetParam().words), std::string::npos) << *fault;
}

TEST(CheckTree, FindsAnythingBehindTheLastCountBesideLists)
{
    std::size_t odd_count = 0;
    for (TreeSample& sample : treeSamples())
    {
        TreeData& tree = sample.tree;
        const bool is_odd = (tree.lists.size() - tree.long_entry_count) % 2 != 0;
        if (is_odd && !tree.voxels_before_leaf.empty())
        {
            ++odd_count;
            tree.voxels_before_leaf.back() |= 1U << 16;
            EXPECT_EQ(checkTree(tree), "there is something behind the last count beside the lists") << sample.name;
        }
    }
    EXPECT_GT(odd_count, 0U);
}

// All bits of a node are determined by the tree's shape or by a number.
TEST(CheckTree, FindsEveryChangeOfANode)
{
    for (const bool is_dag : {false, true})
    {
        const TreeData sound = soundTree(is_dag);
        for (std::size_t i = 0; i < sound.nodes.size() * 128; ++i)
        {
            TreeData tree = sound;
            gpu::Node& node = tree.nodes[i / 128];
            gpu::uint* const words[] = {&node.mask_lo, &node.base_lo, &node.mask_hi, &node.base_hi};
            *words[i / 32 % 4] ^= 1U << (i % 32);
            ASSERT_NE(checkTree(tree), std::nullopt) << "bit " << i;
        }
    }
}

// An entry may refer to another node with equal counts below it. Then the voxels are as many, in order, and in the
// grid.
TEST(CheckTree, FindsEveryChangeOfAnEntryThatMatters)
{
    std::size_t accepted_count = 0;
    const TreeData sound = soundTree(true);
    for (std::size_t i = 0; i < sound.lists.size() * 32; ++i)
    {
        TreeData tree = sound;
        tree.lists[i / 32] ^= 1U << (i % 32);
        if (checkTree(tree) == std::nullopt)
        {
            ++accepted_count;
            std::vector<std::uint64_t> codes;
            forEachVoxel(tree, [&codes](std::uint64_t code) { codes.push_back(code); });
            ASSERT_EQ(codes.size(), tree.voxel_count);
            ASSERT_TRUE(std::is_sorted(codes.begin(), codes.end()));
            ASSERT_LT(codes.back(), std::uint64_t{1} << (3 * tree.grid.depth));
        }
    }
    EXPECT_LT(accepted_count, sound.lists.size() * 32 / 10); // most nodes of a random tree differ
}

} // namespace
} // namespace zvo::test
