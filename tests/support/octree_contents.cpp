// SPDX-License-Identifier: MIT
#include "support/octree_contents.h"

#include "oracle/dag.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace zvo::test
{

namespace
{

std::string describe(const Cell& cell)
{
    return fmt::format("level {} code {:#x} color {:#x} normal {:#x} emission {:#x}", cell.level, cell.code,
                       cell.attribute.color, cell.attribute.normal, cell.emission);
}

bool isSet(const gpu::Node& node, std::uint32_t c)
{
    return ((c < 32 ? node.mask_lo : node.mask_hi) >> (c & 31U) & 1U) != 0;
}

// Sets a child of node. Calls must come in the order of the children.
void addChild(gpu::Node& node, std::uint32_t c, std::uint32_t number)
{
    if ((node.mask_lo | node.mask_hi) == 0)
    {
        node.base_lo = number;
        node.base_hi = number;
    }
    if (c < 32)
    {
        node.mask_lo |= 1U << c;
        ++node.base_hi;
    }
    else
    {
        node.mask_hi |= 1U << (c - 32);
    }
}

struct NodeOnPath
{
    std::uint64_t code = 0;
    std::uint32_t node = 0;
    bool listed = false; // found in a list, so its rank gives the indices of its attributes
    gpu::BeforeChild rank{0, 0};
};

/// A tree in the host's memory.
class TreeReader
{
public:
    TreeReader(vk::HeadlessDevice& device, const DeviceTree& tree)
        : m_levels(tree.grid.nodeLevels()), m_nodes(device.download(tree.nodes)), m_inner_count(tree.innerCount()),
          m_attributes(device.download(tree.voxel_attributes)), m_averages(device.download(tree.node_attributes)),
          m_emission_words(device.download(tree.emission_words)), m_emission(device.download(tree.emission))
    {
        m_attribute_offset = tree.hasOverlays() ? tree.attributeOffset() : 0;
        const std::vector<gpu::uvec2> leaf_groups = device.download(tree.leaf_groups);
        m_words_of_leaf = tree.filled && tree.isDag() ? 2 : 1;
        m_full_node = tree.filled && tree.isDag() ? tree.node_count : UINT32_MAX;
        const std::uint32_t to_surface = !tree.filled ? 0 : tree.isDag() ? 1 : 2 * leaf_groups.at(1).x;
        std::uint32_t voxels = 0;
        for (std::uint32_t leaf = 0; leaf < tree.leaf_words; ++leaf)
        {
            const std::uint32_t word = 2 * m_inner_count + m_words_of_leaf * leaf;
            const gpu::uvec2 mask = wordAt(word);
            const gpu::uvec2 surface = wordAt(word + to_surface);
            const auto low_count = static_cast<std::uint32_t>(std::popcount(surface.x));
            m_leaves.push_back({mask.x, voxels, mask.y, voxels + low_count});
            m_surfaces.push_back({surface.x, voxels, surface.y, voxels + low_count});
            voxels += tree.isDag() ? 0 : low_count + static_cast<std::uint32_t>(std::popcount(surface.y));
        }
        if (!tree.isDag())
        {
            return;
        }
        m_before = device.download(tree.lists.before);
        m_voxels_before_leaf = device.download(tree.lists.voxels_before_leaf);
        m_entries_per_word = tree.lists.entries_per_word;
        m_first_entry = tree.nodeWords() * m_entries_per_word;
        m_long_count = tree.lists.long_entry_count;
        m_first_overlay_node = static_cast<std::uint32_t>(m_nodes.size());
        if (tree.hasOverlays())
        {
            m_ranks = device.download(tree.overlays.ranks);
            m_first_overlay_node = tree.overlays.static_root + 1;
        }
    }

    [[nodiscard]] const gpu::Node& node(const NodeOnPath& place) const
    {
        return isLeafWord(place) ? m_leaves.at(leafOf(place)) : m_nodes.at(place.node & ~gpu::kFullNodes);
    }

    [[nodiscard]] gpu::Attribute average(const NodeOnPath& place) const
    {
        if (isFull(place.node))
        {
            return m_averages.empty() ? gpu::Attribute{} : kInside;
        }
        const bool is_static = place.node < m_inner_count;
        const std::uint32_t own =
            isLeafWord(place) ? m_inner_count + leafOf(place) : place.node + (is_static ? 0 : m_attribute_offset);
        return m_averages.empty() ? gpu::Attribute{} : m_averages.at(place.listed ? place.rank.nodes : own);
    }

    // The child in cell c of parent, which must be set. level: of the child.
    [[nodiscard]] NodeOnPath child(const NodeOnPath& parent, std::uint32_t c, std::uint32_t level) const
    {
        NodeOnPath child;
        child.code = parent.code << 6 | c;
        child.node = named(parent, c);
        if (m_entries_per_word != 0 && (child.node & gpu::kChildList) != 0)
        {
            const std::uint64_t place = child.node & ~gpu::kListFlags;
            child.rank = rankAt(parent, place, level);
            child.node = oracle::entryAt(m_nodes, place, m_entries_per_word) | (child.node & gpu::kLeafWords);
            child.listed = true;
        }
        return child;
    }

    // The voxel in cell c of leaf, which must be set.
    [[nodiscard]] Cell voxel(const NodeOnPath& leaf, std::uint32_t c) const
    {
        Cell cell = {m_levels, leaf.code << 6 | c, {}, 0};
        const gpu::Node& surface = surfaceOf(leaf);
        const bool is_inside = !isSet(surface, c);
        const std::uint32_t voxel = namedBy(surface, c) + (leaf.listed ? leaf.rank.voxels : 0);
        if (!m_attributes.empty())
        {
            cell.attribute = is_inside ? kInside : m_attributes.at(voxel);
        }
        if (((cell.attribute.color >> 24) & gpu::kAttributeEmissive) != 0)
        {
            const gpu::uvec2 word = m_emission_words.at(voxel / 32);
            const std::uint32_t below = (1U << (voxel % 32)) - 1;
            cell.emission = m_emission.at(word.y + static_cast<std::uint32_t>(std::popcount(word.x & below)));
        }
        return cell;
    }

private:
    static bool isLeafWord(const NodeOnPath& place) { return (place.node & gpu::kLeafWords) != 0; }
    [[nodiscard]] std::uint32_t leafOf(const NodeOnPath& place) const
    {
        return ((place.node & ~gpu::kLeafWords) - 2 * m_inner_count) / m_words_of_leaf;
    }
    [[nodiscard]] gpu::uvec2 wordAt(std::uint32_t word) const
    {
        const gpu::Node& pair = m_nodes.at(word / 2);
        return word % 2 == 0 ? gpu::uvec2(pair.mask_lo, pair.base_lo) : gpu::uvec2(pair.mask_hi, pair.base_hi);
    }

    // Whether a reference names one of the full nodes.
    [[nodiscard]] bool isFull(std::uint32_t reference) const
    {
        return reference == m_full_node || (m_entries_per_word == 0 && (reference & gpu::kFullNodes) != 0);
    }

    // The voxels of a leaf that have attributes.
    [[nodiscard]] const gpu::Node& surfaceOf(const NodeOnPath& leaf) const
    {
        static constexpr gpu::Node kNone{};
        NodeOnPath named = leaf;
        if (leaf.node == m_full_node)
        {
            return kNone;
        }
        if (!isLeafWord(leaf) && isFull(node(leaf).base_lo)) // of an overlay, or a full node
        {
            named.node = node(leaf).base_lo & ~gpu::kFullNodes;
            if (!isLeafWord(named))
            {
                return kNone;
            }
        }
        return isLeafWord(named) ? m_surfaces.at(leafOf(named)) : node(named);
    }

    // The child's number that the node's bases give for cell c: base + children before it.
    [[nodiscard]] std::uint32_t named(const NodeOnPath& place, std::uint32_t c) const
    {
        return namedBy(node(place), c);
    }

    static std::uint32_t namedBy(const gpu::Node& n, std::uint32_t c)
    {
        const std::uint32_t below = (c < 32 ? n.mask_lo : n.mask_hi) & ((1U << (c & 31U)) - 1);
        return (c < 32 ? n.base_lo : n.base_hi) + static_cast<std::uint32_t>(std::popcount(below));
    }

    [[nodiscard]] gpu::BeforeChild rankAt(const NodeOnPath& parent, std::uint64_t place, std::uint32_t level) const
    {
        const bool is_full = place < m_first_entry + gpu::kFullEntries && m_full_node != UINT32_MAX;
        if (is_full || (m_before.empty() && m_voxels_before_leaf.empty()))
        {
            return {0, 0};
        }
        const bool in_overlay = parent.node >= m_first_overlay_node;
        gpu::BeforeChild rank = in_overlay ? m_ranks.at(parent.node - m_first_overlay_node) : parent.rank;
        gpu::BeforeChild before{};
        if (level + 1 < m_levels)
        {
            before = m_before.at(place - m_first_entry);
        }
        else
        {
            const std::uint64_t entry = place - m_first_entry - m_long_count;
            before.voxels = m_voxels_before_leaf.at(entry / 2) >> 16 * (entry % 2) & 65535;
            before.nodes = static_cast<std::uint32_t>(place) - (node(parent).base_lo & ~gpu::kListFlags);
        }
        return {rank.voxels + before.voxels, rank.nodes + 1 + before.nodes};
    }

    std::uint32_t m_levels;
    std::vector<gpu::Node> m_nodes;
    std::uint32_t m_inner_count;
    std::vector<gpu::Node> m_leaves;   // the leaf words as nodes
    std::vector<gpu::Node> m_surfaces; // their voxels that have attributes
    std::vector<gpu::Attribute> m_attributes;
    std::vector<gpu::Attribute> m_averages;
    std::vector<gpu::uvec2> m_emission_words;
    std::vector<gpu::uint> m_emission;
    std::vector<gpu::BeforeChild> m_before;
    std::vector<gpu::uint> m_voxels_before_leaf;
    std::vector<gpu::BeforeChild> m_ranks;
    std::uint32_t m_words_of_leaf = 1;
    std::uint32_t m_full_node = UINT32_MAX; // of a filled DAG
    std::uint32_t m_entries_per_word = 0;
    std::uint64_t m_first_entry = 0;
    std::uint64_t m_long_count = 0;
    std::uint32_t m_first_overlay_node = 0;
    std::uint32_t m_attribute_offset = 0;
};

} // namespace

std::vector<Cell> cellsOf(vk::HeadlessDevice& device, const DeviceTree& tree)
{
    std::vector<Cell> cells;
    if (tree.node_count == 0)
    {
        return cells;
    }
    const TreeReader reader(device, tree);
    std::vector<NodeOnPath> level(1);
    if ((reader.node(level[0]).mask_lo | reader.node(level[0]).mask_hi) == 0)
    {
        return cells;
    }
    const std::uint32_t level_count = tree.grid.nodeLevels();
    std::vector<Cell> voxels;
    for (std::uint32_t depth = 0; depth < level_count; ++depth)
    {
        std::vector<NodeOnPath> children;
        for (const NodeOnPath& place : level)
        {
            cells.push_back({depth, place.code, reader.average(place), 0});
            for (std::uint32_t c = 0; c < 64; ++c)
            {
                if (isSet(reader.node(place), c) && depth + 1 < level_count)
                {
                    children.push_back(reader.child(place, c, depth + 1));
                }
                else if (isSet(reader.node(place), c))
                {
                    voxels.push_back(reader.voxel(place, c));
                }
            }
        }
        level = std::move(children);
    }
    cells.insert(cells.end(), voxels.begin(), voxels.end());
    return cells;
}

DeviceTree octreeOf(vk::HeadlessDevice& device, const std::vector<Cell>& cells, const Grid& grid, float emission_scale)
{
    const std::uint32_t levels = grid.nodeLevels();
    const auto node_count = static_cast<std::size_t>(std::ranges::find(cells, levels, &Cell::level) - cells.begin());
    std::vector<gpu::Node> nodes(node_count);
    std::vector<gpu::Attribute> averages;
    std::vector<gpu::Attribute> attributes;
    std::vector<gpu::uvec2> words;
    std::vector<gpu::uint> emission;
    DeviceTree octree;
    octree.grid = grid;
    octree.node_count = static_cast<std::uint32_t>(node_count);
    octree.voxel_count = static_cast<std::uint32_t>(cells.size() - node_count);
    octree.emission_scale = emission_scale;
    std::size_t parent = 0; // a node's number is its index in cells
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        const Cell& cell = cells[i];
        const bool is_voxel = cell.level == levels;
        const auto number = static_cast<std::uint32_t>(is_voxel ? i - node_count : i);
        if (i != 0)
        {
            while (cells.at(parent).level + 1 != cell.level || cells.at(parent).code != cell.code >> 6)
            {
                ++parent;
            }
            addChild(nodes.at(parent), static_cast<std::uint32_t>(cell.code & 63U), number);
        }
        if (!is_voxel)
        {
            octree.levels.resize(cell.level + 1, {number, 0});
            ++octree.levels.back().node_count;
            averages.push_back(cell.attribute);
            continue;
        }
        attributes.push_back(cell.attribute);
        if (number % 32 == 0)
        {
            words.emplace_back(0U, static_cast<std::uint32_t>(emission.size()));
        }
        if (((cell.attribute.color >> 24) & gpu::kAttributeEmissive) != 0)
        {
            words.back().x |= 1U << (number % 32);
            emission.push_back(cell.emission);
        }
    }
    octree.nodes = device.makeBuffer("nodes", std::span<const gpu::Node>(nodes));
    octree.node_attributes = device.makeBuffer("node attributes", std::span<const gpu::Attribute>(averages));
    octree.voxel_attributes = device.makeBuffer("voxel attributes", std::span<const gpu::Attribute>(attributes));
    octree.emission_words = device.makeBuffer("emission words", std::span<const gpu::uvec2>(words));
    octree.emission = device.makeBuffer("emission", std::span<const gpu::uint>(emission));
    return octree;
}

std::string difference(const std::vector<Cell>& actual, const std::vector<Cell>& expected)
{
    const auto [a, e] = std::ranges::mismatch(actual, expected);
    if (a == actual.end() && e == expected.end())
    {
        return "";
    }
    return fmt::format("{} cells instead of {}; the first difference: {} instead of {}", actual.size(), expected.size(),
                       a == actual.end() ? "nothing" : describe(*a), e == expected.end() ? "nothing" : describe(*e));
}

} // namespace zvo::test
