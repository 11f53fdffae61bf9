// SPDX-License-Identifier: MIT
#include "support/tree_samples.h"

#include "oracle/attribute_formats.h"
#include "oracle/dag.h"
#include "oracle/octree_check.h"
#include "support/same_bytes.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

namespace zvo::test
{

TreeData octreeOf(std::span<const std::uint64_t> codes, std::uint32_t depth)
{
    oracle::ReferenceOctree reference = oracle::referenceOctree(codes, depth);
    TreeData tree;
    tree.grid.depth = depth;
    tree.voxel_count = static_cast<std::uint32_t>(codes.size());
    tree.octree_node_count = static_cast<std::uint32_t>(reference.nodes.size());
    for (const oracle::NodeRange& range : reference.levels)
    {
        tree.levels.push_back({range.first_node, range.node_count});
    }
    tree.nodes = std::move(reference.nodes);
    return tree;
}

void addAttributes(TreeData& octree)
{
    std::mt19937 random(octree.voxel_count);
    octree.emission_words.resize((octree.voxel_count + 31) / 32, gpu::uvec2(0));
    for (std::uint32_t i = 0; i < octree.voxel_count; ++i)
    {
        const bool emissive = random() % 7 == 0;
        const auto color = static_cast<std::uint32_t>(random() & 0xFFFFFF);
        octree.voxel_attributes.push_back({color | (emissive ? gpu::kAttributeEmissive << 24 : 0),
                                           random() % 8 == 0 ? gpu::kNoNormal : static_cast<gpu::uint>(random())});
        octree.emission_words[i / 32].y =
            i % 32 == 0 ? static_cast<gpu::uint>(octree.emission.size()) : octree.emission_words[i / 32].y;
        if (emissive)
        {
            octree.emission_words[i / 32].x |= 1U << (i % 32);
            octree.emission.push_back(static_cast<gpu::uint>(random() % (1U << 27)) | 16U << 27);
        }
    }
    for (std::size_t i = 0; i < octree.nodes.size(); ++i)
    {
        octree.node_attributes.push_back(
            {static_cast<gpu::uint>(random() & 0xFFFFFF), static_cast<gpu::uint>(random())});
    }
    octree.emission_scale = 2.5F;
}

TreeData packedTree(const TreeData& tree, AttributeFormat format)
{
    TreeData packed = tree;
    packed.packed.format = format;
    constexpr std::size_t kBlock = 16;
    for (std::span<const gpu::Attribute> rest = tree.voxel_attributes; !rest.empty();)
    {
        const std::size_t count = format == AttributeFormat::Blocks ? std::min(rest.size(), kBlock) : 1;
        if (format == AttributeFormat::Blocks)
        {
            const oracle::Block block = oracle::packBlock(rest.first(count));
            packed.packed.voxels.insert(packed.packed.voxels.end(), block.begin(), block.end());
        }
        else
        {
            packed.packed.voxels.push_back(oracle::packAttribute4(rest.front()));
        }
        rest = rest.subspan(count);
    }
    for (const gpu::Attribute& attribute : tree.node_attributes)
    {
        packed.packed.nodes.push_back(oracle::packAttribute4(attribute));
    }
    packed.voxel_attributes.clear();
    packed.node_attributes.clear();
    return packed;
}

TreeData dagOf(const TreeData& octree)
{
    std::vector<oracle::NodeRange> levels;
    for (const DeviceTree::Level& level : octree.levels)
    {
        levels.push_back({level.first_node, level.node_count});
    }
    oracle::ReferenceDag reference = oracle::referenceDag(octree.nodes, levels);
    TreeData dag = octree;
    dag.structure = TreeStructure::Svdag;
    dag.levels.clear();
    for (const oracle::NodeRange& range : reference.levels)
    {
        dag.levels.push_back({range.first_node, range.node_count});
    }
    dag.nodes.assign(reference.pool.begin(), reference.pool.begin() + reference.node_count);
    for (std::uint64_t i = 0; i < reference.entry_count; ++i)
    {
        const std::uint64_t place = std::uint64_t{2} * reference.node_count * reference.entries_per_word + i;
        dag.lists.push_back(oracle::entryAt(reference.pool, place, reference.entries_per_word));
    }
    dag.long_entry_count = reference.long_entry_count;
    dag.node_attributes.clear();
    if (octree.hasAttributes())
    {
        dag.before = std::move(reference.before);
        dag.voxels_before_leaf = std::move(reference.voxels_before_leaf);
        for (const std::uint32_t node : reference.depth_first)
        {
            dag.node_attributes.push_back(octree.node_attributes[node]);
        }
    }
    return dag;
}

std::vector<TreeSample> treeSamples()
{
    std::vector<TreeSample> samples;
    const auto add = [&samples](const std::string& name, const std::vector<std::uint64_t>& codes, std::uint32_t depth)
    {
        TreeData octree = octreeOf(codes, depth);
        octree.grid.origin = {-3.5F, 2.0F, 0.125F};
        octree.grid.voxel_size = 0.1F;
        samples.push_back({name, octree});
        samples.push_back({name + "_dag", dagOf(octree)});
        if (!codes.empty())
        {
            addAttributes(octree);
            samples.push_back({name + "_with_attributes", octree});
            samples.push_back({name + "_with_attributes_dag", dagOf(octree)});
        }
        if (name == "one_voxel" || name == "random_3" || name == "random_5")
        {
            for (const AttributeFormat format : {AttributeFormat::Bytes4, AttributeFormat::Blocks})
            {
                const std::string packed_name = name + "_with_attributes_" + formatName(format);
                samples.push_back({packed_name, packedTree(octree, format)});
                samples.push_back({packed_name + "_dag", packedTree(dagOf(octree), format)});
            }
        }
    };
    add("nothing", {}, 5);
    add("one_voxel", {0}, 1);
    add("far_corner", {0777777}, 6);
    std::vector<std::uint64_t> full(1 << 9);
    std::iota(full.begin(), full.end(), 0);
    add("full_8", full, 3);
    full.resize(1 << 6);
    add("full_4", full, 2);
    std::mt19937 random(5);
    for (const std::uint32_t depth : {1U, 2U, 3U, 4U, 5U, 6U})
    {
        std::vector<std::uint64_t> codes(60 * depth);
        std::generate(codes.begin(), codes.end(), [&] { return random() & ((std::uint64_t{1} << (3 * depth)) - 1); });
        std::sort(codes.begin(), codes.end());
        codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
        add("random_" + std::to_string(depth), codes, depth);
    }
    std::vector<std::uint64_t> checkers;
    for (std::uint64_t code = 0; code < 1U << 15; ++code)
    {
        if (std::popcount(code & 7) % 2 == 0)
        {
            checkers.push_back(code);
        }
    }
    add("checkers", checkers, 5);
    return samples;
}

TreeData treeSample(const std::string& name)
{
    for (TreeSample& sample : treeSamples())
    {
        if (sample.name == name)
        {
            return std::move(sample.tree);
        }
    }
    throw std::out_of_range(name);
}

std::string treeDifference(const TreeData& actual, const TreeData& expected)
{
    const auto sameLevels = [](const DeviceTree::Level& a, const DeviceTree::Level& b)
    { return a.first_node == b.first_node && a.node_count == b.node_count; };
    const std::pair<const char*, bool> parts[] = {
        {"structure", actual.structure == expected.structure},
        {"origin", actual.grid.origin == expected.grid.origin},
        {"voxel size", actual.grid.voxel_size == expected.grid.voxel_size},
        {"depth", actual.grid.depth == expected.grid.depth},
        {"voxel count", actual.voxel_count == expected.voxel_count},
        {"octree node count", actual.octree_node_count == expected.octree_node_count},
        {"long entry count", actual.long_entry_count == expected.long_entry_count},
        {"levels", std::equal(actual.levels.begin(), actual.levels.end(), expected.levels.begin(),
                              expected.levels.end(), sameLevels)},
        {"nodes", sameBytes(actual.nodes, expected.nodes)},
        {"lists", actual.lists == expected.lists},
        {"before", sameBytes(actual.before, expected.before)},
        {"voxels before leaf", actual.voxels_before_leaf == expected.voxels_before_leaf},
        {"voxel attributes", sameBytes(actual.voxel_attributes, expected.voxel_attributes)},
        {"node attributes", sameBytes(actual.node_attributes, expected.node_attributes)},
        {"format of attributes", actual.attributeFormat() == expected.attributeFormat()},
        {"packed voxel attributes", actual.packed.voxels == expected.packed.voxels},
        {"packed node attributes", actual.packed.nodes == expected.packed.nodes},
        {"emission words", sameBytes(actual.emission_words, expected.emission_words)},
        {"emission", actual.emission == expected.emission},
        {"emission scale", actual.emission_scale == expected.emission_scale},
    };
    for (const auto& [name, is_same] : parts)
    {
        if (!is_same)
        {
            return name;
        }
    }
    return "";
}

} // namespace zvo::test
