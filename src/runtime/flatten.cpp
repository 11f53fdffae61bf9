// SPDX-License-Identifier: MIT
#include "runtime/flatten.h"

#include "core/base/divide_up.h"
#include "core/tree/leaf_words.h"
#include "zvo/error.h"

#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::uint32_t kCellsOfHalf = 32;

// A node on the way down.
struct NodeOnPath
{
    std::uint32_t node = 0;
    gpu::BeforeChild rank{0, 0}; // of the static octree's node, where it stands in a list
    bool is_listed = false;
};

/// A tree in the host's memory, as it is traced.
class Source
{
public:
    Source(vk::HeadlessDevice& device, const DeviceTree& tree)
        : m_nodes(device.download(tree.nodes)), m_words(wordsOf(m_nodes)), m_inner_count(tree.innerCount()),
          m_voxels(device.download(tree.voxel_attributes)), m_averages(device.download(tree.node_attributes)),
          m_emission_words(device.download(tree.emission_words)), m_emission(device.download(tree.emission))
    {
        m_attribute_offset = tree.hasOverlays() ? tree.attributeOffset() : 0;
        m_is_filled = tree.filled;
        if (!tree.isDag())
        {
            const std::uint64_t first = 2 * std::uint64_t{m_inner_count};
            m_to_surface = tree.filled ? tree.nodeWords() - tree.leaf_words - first : 0;
            std::uint32_t voxels = 0;
            for (std::uint64_t word = first + m_to_surface; word < first + m_to_surface + tree.leaf_words; ++word)
            {
                m_first_voxels.push_back(voxels);
                voxels += static_cast<std::uint32_t>(std::popcount(m_words[word]));
            }
            return;
        }
        m_before = device.download(tree.lists.before);
        m_voxels_before_leaf = device.download(tree.lists.voxels_before_leaf);
        const ListPacking packing = tree.packing();
        m_entries = unpackEntries(std::span(m_words).subspan(packing.node_words, packing.wordCount()),
                                  packing.entry_count, packing.per_word);
        m_first_entry = packing.firstEntry();
        m_first_short_entry = m_first_entry + tree.lists.long_entry_count;
        m_full_base = gpu::kChildList | static_cast<std::uint32_t>(m_first_entry);
        m_to_surface = tree.filled ? 1 : 0;
        m_first_overlay_node = static_cast<std::uint32_t>(m_nodes.size());
        if (tree.hasOverlays())
        {
            m_ranks = device.download(tree.overlays.ranks);
            m_first_overlay_node = tree.overlays.static_root + 1;
        }
    }

    [[nodiscard]] gpu::Node node(const NodeOnPath& at) const
    {
        if ((at.node & gpu::kLeafWords) == 0)
        {
            return m_nodes[at.node];
        }
        return leafOf(at.node & ~gpu::kLeafWords, 0);
    }

    // Whether a node is full, or a leaf has the voxels of another one.
    [[nodiscard]] bool isFull(const gpu::Node& node) const
    {
        const bool is_dag = !m_entries.empty();
        return m_is_filled && (is_dag ? node.base_lo == m_full_base : (node.base_lo & gpu::kFullNodes) != 0);
    }

    // A leaf with those of its voxels that have attributes.
    [[nodiscard]] gpu::Node surface(const NodeOnPath& leaf) const
    {
        std::uint32_t named = leaf.node;
        if ((named & gpu::kLeafWords) == 0 && isFull(m_nodes[named]))
        {
            named = m_nodes[named].base_lo & ~gpu::kFullNodes;
            if ((named & gpu::kLeafWords) == 0)
            {
                return {};
            }
        }
        return (named & gpu::kLeafWords) == 0 ? m_nodes[named] : leafOf(named & ~gpu::kLeafWords, m_to_surface);
    }
    [[nodiscard]] bool isFilled() const { return m_is_filled; }
    [[nodiscard]] bool hasAttributes() const { return !m_voxels.empty(); }
    [[nodiscard]] bool hasAverages() const { return !m_averages.empty(); }

    [[nodiscard]] const gpu::Attribute& average(const NodeOnPath& at) const
    {
        if (at.is_listed)
        {
            return m_averages[at.rank.nodes];
        }
        if ((at.node & gpu::kLeafWords) != 0)
        {
            return m_averages[(at.node & ~gpu::kLeafWords) - m_inner_count];
        }
        return m_averages[at.node < m_inner_count ? at.node : at.node + m_attribute_offset]; // modulo 2^32
    }

    // What a node's base and the rank of a child in its half name.
    [[nodiscard]] NodeOnPath child(const NodeOnPath& parent, std::uint32_t base, std::uint32_t rank, bool is_leaf) const
    {
        if ((base & gpu::kChildList) == 0 || m_entries.empty())
        {
            return {.node = base + rank};
        }
        const std::uint32_t index = (base & ~gpu::kListFlags) + rank;
        return {.node = m_entries[index - m_first_entry] | (base & gpu::kLeafWords),
                .rank = rankOf(parent, index, is_leaf),
                .is_listed = true};
    }

    // The attribute, and what is emitted, of a leaf's voxel.
    [[nodiscard]] const gpu::Attribute& voxel(std::uint64_t index) const { return m_voxels[index]; }
    [[nodiscard]] std::uint32_t firstVoxel(const NodeOnPath& leaf) const
    {
        return leaf.is_listed ? leaf.rank.voxels : 0;
    }
    [[nodiscard]] std::uint32_t emission(std::uint64_t index) const
    {
        const gpu::uvec2& word = m_emission_words[index / gpu::kVoxelsPerEmissionWord];
        const std::uint32_t below = (1U << index % gpu::kVoxelsPerEmissionWord) - 1;
        return m_emission[word.y + static_cast<std::uint32_t>(std::popcount(word.x & below))];
    }

private:
    // The mask of a leaf word, or another one of the same leaf, and its bases.
    [[nodiscard]] gpu::Node leafOf(std::uint32_t word, std::uint64_t to_mask) const
    {
        const std::uint64_t mask = m_words[word + to_mask];
        const auto mask_lo = static_cast<gpu::uint>(mask);
        const std::uint32_t first = m_first_voxels.empty() ? 0 : m_first_voxels[word - 2 * m_inner_count];
        return {mask_lo, first, static_cast<gpu::uint>(mask >> 32),
                first + static_cast<std::uint32_t>(std::popcount(mask_lo))};
    }

    [[nodiscard]] gpu::BeforeChild rankOf(const NodeOnPath& parent, std::uint32_t index, bool is_leaf) const
    {
        if (m_voxels.empty())
        {
            return {0, 0};
        }
        const bool in_overlay = parent.node >= m_first_overlay_node;
        const gpu::BeforeChild& rank = in_overlay ? m_ranks[parent.node - m_first_overlay_node] : parent.rank;
        if (!is_leaf)
        {
            const gpu::BeforeChild& before = m_before[index - m_first_entry];
            return {rank.voxels + before.voxels, rank.nodes + 1 + before.nodes};
        }
        const std::uint64_t entry = index - m_first_short_entry;
        const std::uint32_t before = m_voxels_before_leaf[entry / 2] >> 16 * (entry % 2) & 0xFFFFU;
        const std::uint32_t first = m_nodes[parent.node].base_lo & ~gpu::kListFlags;
        return {rank.voxels + before, rank.nodes + 1 + (index - first)};
    }

    std::vector<gpu::Node> m_nodes;
    std::vector<std::uint64_t> m_words; // the same
    std::uint32_t m_inner_count;        // of the static tree
    bool m_is_filled = false;
    std::uint64_t m_to_surface = 0;            // from a leaf word to its surface mask, in words
    std::vector<std::uint32_t> m_first_voxels; // of the leaf words of an octree
    std::vector<gpu::Attribute> m_voxels;
    std::vector<gpu::Attribute> m_averages;
    std::vector<gpu::uvec2> m_emission_words;
    std::vector<gpu::uint> m_emission;
    std::vector<gpu::uint> m_entries;
    std::vector<gpu::BeforeChild> m_before;
    std::vector<gpu::uint> m_voxels_before_leaf;
    std::vector<gpu::BeforeChild> m_ranks;
    std::uint64_t m_first_entry = 0;
    std::uint32_t m_full_base = 0; // of full nodes of a DAG
    std::uint64_t m_first_short_entry = 0;
    std::uint32_t m_first_overlay_node = 0;
    std::uint32_t m_attribute_offset = 0;
};

/// Makes the octree, level by level.
class Flattener
{
public:
    Flattener(const Source& source, const DeviceTree& octree)
        : m_source(source), m_level_count(octree.grid.nodeLevels())
    {
        m_tree.grid = octree.grid;
        m_tree.emission_scale = octree.emission_scale;
    }

    TreeData run()
    {
        std::vector<NodeOnPath> level(1);
        if (cellMask(m_source.node(level.front())) == 0)
        {
            return std::move(m_tree);
        }
        for (std::uint32_t depth = 0; depth < m_level_count; ++depth)
        {
            level = addLevel(level, depth);
        }
        m_tree.voxel_count = static_cast<std::uint32_t>(m_voxel_count);
        m_tree.octree_node_count = static_cast<std::uint32_t>(m_tree.nodes.size());
        m_tree.interior_count = interiorCount(m_tree);
        if (m_tree.emission.empty())
        {
            m_tree.emission_words.clear();
            m_tree.emission_scale = 1.0F;
        }
        return std::move(m_tree);
    }

private:
    // Adds a level's nodes, whose children follow them all; returns those.
    std::vector<NodeOnPath> addLevel(const std::vector<NodeOnPath>& level, std::uint32_t depth)
    {
        const bool are_leaves = depth + 1 == m_level_count;
        std::vector<NodeOnPath> children;
        m_tree.levels.push_back(
            {static_cast<std::uint32_t>(m_tree.nodes.size()), static_cast<std::uint32_t>(level.size())});
        const std::uint64_t first_child = m_tree.nodes.size() + level.size();
        for (const NodeOnPath& at : level)
        {
            gpu::Node node = are_leaves ? m_source.surface(at) : m_source.node(at);
            if (are_leaves && m_source.isFilled())
            {
                m_tree.occupied.push_back(cellMask(m_source.node(at)));
            }
            else if (m_source.isFull(node)) // TreeData has no nodes below
            {
                node = {};
            }
            const std::uint64_t first = are_leaves ? m_voxel_count : first_child + children.size();
            addHalf(at, node.mask_lo, node.base_lo, depth, children);
            addHalf(at, node.mask_hi, node.base_hi, depth, children);
            node.base_lo = static_cast<std::uint32_t>(first);
            node.base_hi = node.base_lo + static_cast<std::uint32_t>(std::popcount(node.mask_lo));
            m_tree.nodes.push_back(node);
            if (m_source.hasAverages())
            {
                m_tree.node_attributes.push_back(m_source.average(at));
            }
        }
        if (m_voxel_count > UINT32_MAX || m_tree.nodes.size() + children.size() > UINT32_MAX)
        {
            throw Error(ErrorCode::Memory, "more voxels or nodes than 32-bit numbers count; lower the resolution");
        }
        return children;
    }

    void addHalf(const NodeOnPath& at, std::uint32_t mask, std::uint32_t base, std::uint32_t depth,
                 std::vector<NodeOnPath>& children)
    {
        const auto count = static_cast<std::uint32_t>(std::popcount(mask));
        static_assert(kCellsOfHalf == 32);
        for (std::uint32_t rank = 0; rank < count; ++rank)
        {
            if (depth + 1 < m_level_count)
            {
                children.push_back(m_source.child(at, base, rank, depth + 2 == m_level_count));
            }
            else
            {
                addVoxel(std::uint64_t{m_source.firstVoxel(at)} + base + rank);
            }
        }
    }

    void addVoxel(std::uint64_t index)
    {
        if (m_source.hasAttributes())
        {
            const gpu::Attribute& look = m_source.voxel(index);
            m_tree.voxel_attributes.push_back(look);
            if (m_voxel_count % gpu::kVoxelsPerEmissionWord == 0)
            {
                m_tree.emission_words.push_back({0, static_cast<std::uint32_t>(m_tree.emission.size())});
            }
            if ((look.color >> 24 & gpu::kAttributeEmissive) != 0)
            {
                m_tree.emission_words.back().x |= 1U << m_voxel_count % gpu::kVoxelsPerEmissionWord;
                m_tree.emission.push_back(m_source.emission(index));
            }
        }
        ++m_voxel_count;
    }

    const Source& m_source;
    std::uint32_t m_level_count;
    std::uint64_t m_voxel_count = 0;
    TreeData m_tree;
};

} // namespace

TreeData flattenTree(vk::HeadlessDevice& device, const DeviceTree& tree)
{
    if (isPacked(tree.attributeFormat()))
    {
        throw Error(ErrorCode::Usage, "only a tree with attributes of 8 bytes can be made an octree again");
    }
    if (tree.node_count == 0)
    {
        TreeData empty;
        empty.grid = tree.grid;
        return empty;
    }
    return Flattener(Source(device, tree), tree).run();
}

} // namespace zvo
