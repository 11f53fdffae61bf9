// SPDX-License-Identifier: MIT
#include "oracle/dag.h"

#include <bit>
#include <map>
#include <utility>

namespace zvo::oracle
{
namespace
{

constexpr std::uint32_t kCells = 64;
constexpr std::uint32_t kWordsPerNode = sizeof(gpu::Node) / sizeof(gpu::uint);

std::uint64_t maskOf(const gpu::Node& node)
{
    return node.mask_lo | std::uint64_t{node.mask_hi} << 32;
}

bool hasCell(const gpu::Node& node, std::uint32_t cell)
{
    return (maskOf(node) >> cell & 1) != 0;
}

std::uint32_t maskBelow(const gpu::Node& node, std::uint32_t cell)
{
    return (cell < 32 ? node.mask_lo : node.mask_hi) & ((1U << (cell & 31)) - 1);
}

/// base + popcount(mask & bits below cell): the index of a child or, in a leaf, of a voxel; for a list, that of its
/// entry.
std::uint64_t placeOf(const gpu::Node& node, std::uint32_t cell)
{
    const std::uint32_t base = (cell < 32 ? node.base_lo : node.base_hi) & ~gpu::kChildList;
    return std::uint64_t{base} + static_cast<std::uint32_t>(std::popcount(maskBelow(node, cell)));
}

/// A word of the pool, as the device reads it.
gpu::uint wordOf(std::span<const gpu::Node> nodes, std::uint64_t word)
{
    const gpu::Node& node = nodes[word / kWordsPerNode];
    switch (word % kWordsPerNode)
    {
    case 0:
        return node.mask_lo;
    case 1:
        return node.base_lo;
    case 2:
        return node.mask_hi;
    default:
        return node.base_hi;
    }
}

/// Entries that 64 bits hold in a DAG of so many nodes.
std::uint32_t entriesPerWord(std::uint64_t node_count)
{
    return node_count <= 65536 ? 4 : node_count <= 2097152 ? 3 : 2;
}

/// Appends entries bit by bit, padded with zeros to whole nodes.
void appendEntries(std::vector<gpu::Node>& nodes, const std::vector<std::uint32_t>& entries, std::uint32_t per_word)
{
    const std::uint32_t width = 64 / per_word;
    std::vector<bool> bits;
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
        bits.resize(i / per_word * 64 + i % per_word * width);
        for (std::uint32_t bit = 0; bit < width; ++bit)
            bits.push_back((entries[i] >> bit & 1) != 0);
    }
    constexpr std::size_t kNodeBits = 32 * kWordsPerNode;
    bits.resize((bits.size() + kNodeBits - 1) / kNodeBits * kNodeBits);
    for (std::size_t first = 0; first < bits.size(); first += kNodeBits)
    {
        std::uint32_t words[kWordsPerNode] = {};
        for (std::size_t bit = 0; bit < kNodeBits; ++bit)
            words[bit / 32] |= (bits[first + bit] ? 1U : 0U) << bit % 32;
        nodes.push_back({words[0], words[1], words[2], words[3]});
    }
}

/// The counts of voxels and nodes below a node of an octree.
struct Below
{
    std::uint32_t voxels = 0;
    std::uint32_t nodes = 0; // including the node itself
};

std::vector<Below> countBelow(std::span<const gpu::Node> nodes, std::span<const NodeRange> levels)
{
    std::vector<Below> below(nodes.size());
    for (std::size_t level = levels.size(); level-- > 0;)
    {
        for (std::uint32_t i = 0; i < levels[level].node_count; ++i)
        {
            const std::uint32_t index = levels[level].first_node + i;
            Below& count = below[index];
            count.nodes = 1;
            if (level + 1 == levels.size())
            {
                count.voxels = static_cast<std::uint32_t>(std::popcount(maskOf(nodes[index])));
                continue;
            }
            for (std::uint32_t cell = 0; cell < kCells; ++cell)
            {
                if (hasCell(nodes[index], cell))
                {
                    count.voxels += below[placeOf(nodes[index], cell)].voxels;
                    count.nodes += below[placeOf(nodes[index], cell)].nodes;
                }
            }
        }
    }
    return below;
}

/// Classes of equal nodes of an octree, level by level.
struct Classes
{
    std::vector<std::uint32_t> class_of;                 // [nodes] number among the classes of their level
    std::vector<std::vector<std::uint32_t>> first_nodes; // [levels][classes] the first node of each
};

Classes findClasses(std::span<const gpu::Node> nodes, std::span<const NodeRange> levels)
{
    Classes classes;
    classes.class_of.resize(nodes.size());
    classes.first_nodes.resize(levels.size());
    for (std::size_t level = levels.size(); level-- > 0;)
    {
        using Content = std::pair<std::uint64_t, std::vector<std::uint32_t>>; // mask, classes of the children
        std::map<Content, std::uint32_t> numbers;
        for (std::uint32_t i = 0; i < levels[level].node_count; ++i)
        {
            const std::uint32_t index = levels[level].first_node + i;
            Content content{maskOf(nodes[index]), {}};
            for (std::uint32_t cell = 0; cell < kCells && level + 1 < levels.size(); ++cell)
                if (hasCell(nodes[index], cell))
                    content.second.push_back(classes.class_of[placeOf(nodes[index], cell)]);
            const auto next = static_cast<std::uint32_t>(numbers.size());
            const auto [found, is_new] = numbers.try_emplace(std::move(content), next);
            if (is_new)
                classes.first_nodes[level].push_back(index);
            classes.class_of[index] = found->second;
        }
    }
    return classes;
}

std::vector<std::uint32_t> depthFirst(std::span<const gpu::Node> nodes, std::size_t level_count)
{
    std::vector<std::uint32_t> order;
    std::vector<std::pair<std::uint32_t, std::size_t>> to_visit; // node, level
    if (level_count != 0)
        to_visit.emplace_back(0, 0);
    while (!to_visit.empty())
    {
        const auto [index, level] = to_visit.back();
        to_visit.pop_back();
        order.push_back(index);
        for (std::uint32_t cell = kCells; cell-- > 0 && level + 1 < level_count;)
            if (hasCell(nodes[index], cell))
                to_visit.emplace_back(static_cast<std::uint32_t>(placeOf(nodes[index], cell)), level + 1);
    }
    return order;
}

} // namespace

// Reads bit by bit.
std::uint32_t entryAt(std::span<const gpu::Node> pool, std::uint64_t place, std::uint32_t entries_per_word)
{
    const std::uint32_t width = 64 / entries_per_word;
    std::uint32_t entry = 0;
    for (std::uint32_t i = 0; i < width; ++i)
    {
        const std::uint64_t bit = place / entries_per_word * 64 + place % entries_per_word * width + i;
        entry |= (wordOf(pool, bit / 32) >> bit % 32 & 1) << i;
    }
    return entry;
}

ReferenceDag referenceDag(std::span<const gpu::Node> nodes, std::span<const NodeRange> levels,
                          std::uint32_t entries_per_word)
{
    ReferenceDag dag;
    dag.octree_node_count = static_cast<std::uint32_t>(nodes.size());
    dag.depth_first = depthFirst(nodes, levels.size());
    const Classes classes = findClasses(nodes, levels);
    const std::vector<Below> below = countBelow(nodes, levels);
    for (const std::vector<std::uint32_t>& of_level : classes.first_nodes)
    {
        const auto count = static_cast<std::uint32_t>(of_level.size());
        dag.levels.push_back({dag.node_count, count});
        dag.node_count += count;
    }

    const std::uint32_t per_word = entries_per_word != 0 ? entries_per_word : entriesPerWord(dag.node_count);
    dag.entries_per_word = per_word;
    const std::uint64_t first_index = std::uint64_t{2} * dag.node_count * per_word;
    std::vector<std::uint32_t> lists;
    std::vector<std::uint32_t> short_entries;
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
        const bool leaf = level + 1 == levels.size();
        const bool above_leaves = level + 2 == levels.size();
        for (const std::uint32_t index : classes.first_nodes[level])
        {
            gpu::Node node = nodes[index];
            const auto lower_count = static_cast<std::uint32_t>(std::popcount(node.mask_lo));
            const auto list = static_cast<std::uint32_t>(first_index + lists.size());
            node.base_lo = leaf ? 0 : gpu::kChildList | list;
            node.base_hi = node.base_lo + lower_count;
            dag.pool.push_back(node);
            Below before;
            for (std::uint32_t cell = 0; cell < kCells && !leaf; ++cell)
            {
                if (!hasCell(nodes[index], cell))
                    continue;
                const std::uint64_t child = placeOf(nodes[index], cell);
                lists.push_back(dag.levels[level + 1].first_node + classes.class_of[child]);
                if (above_leaves)
                    short_entries.push_back(before.voxels);
                else
                    dag.before.push_back({before.voxels, before.nodes});
                before.voxels += below[child].voxels;
                before.nodes += below[child].nodes;
            }
        }
    }
    appendEntries(dag.pool, lists, per_word);
    dag.entry_count = lists.size();
    dag.long_entry_count = dag.before.size();
    for (std::size_t i = 0; i < short_entries.size(); i += 2)
        dag.voxels_before_leaf.push_back(short_entries[i] |
                                         (i + 1 < short_entries.size() ? short_entries[i + 1] << 16 : 0));
    return dag;
}

LeafWordPool leafWordPool(const ReferenceDag& dag, std::uint32_t entries_per_word)
{
    LeafWordPool pool;
    pool.leaf_words = dag.levels.size() > 1 ? dag.levels.back().node_count : 0;
    const std::uint32_t inner_count = dag.node_count - pool.leaf_words;
    const std::uint32_t word_count = 2 * inner_count + pool.leaf_words;
    const std::uint32_t per_word = entries_per_word != 0 ? entries_per_word : entriesPerWord(word_count);
    pool.entries_per_word = per_word;
    const std::uint64_t first_place = std::uint64_t{2} * dag.node_count * dag.entries_per_word;
    std::vector<std::uint32_t> words; // halves
    for (std::uint32_t i = 0; i < dag.node_count; ++i)
    {
        const gpu::Node& node = dag.pool[i];
        if (i >= inner_count)
        {
            words.insert(words.end(), {node.mask_lo, node.mask_hi});
            continue;
        }
        const bool above_leaves = i >= dag.levels[dag.levels.size() - 2].first_node;
        const std::uint64_t list = (node.base_lo & ~gpu::kChildList) - first_place;
        const std::uint32_t base = gpu::kChildList | (above_leaves ? gpu::kLeafWords : 0) |
                                   static_cast<std::uint32_t>(word_count * per_word + list);
        words.insert(words.end(), {node.mask_lo, base, node.mask_hi,
                                   base + static_cast<std::uint32_t>(std::popcount(node.mask_lo))});
    }
    std::vector<std::uint32_t> entries(std::size_t{word_count} * per_word); // those in the room of nodes are no entries
    for (std::uint64_t i = 0; i < dag.entry_count; ++i)
        entries.push_back(entryAt(dag.pool, first_place + i, dag.entries_per_word) +
                          (i >= dag.long_entry_count ? inner_count : 0));
    appendEntries(pool.nodes, entries, per_word);
    if (pool.leaf_words == 0)
        pool.nodes = dag.pool;
    for (std::size_t i = 0; i < words.size() && pool.leaf_words != 0; ++i)
    {
        gpu::Node& node = pool.nodes[i / kWordsPerNode];
        gpu::uint* const parts[] = {&node.mask_lo, &node.base_lo, &node.mask_hi, &node.base_hi};
        *parts[i % kWordsPerNode] = words[i];
    }
    return pool;
}

namespace
{

class Expander
{
public:
    Expander(std::span<const gpu::Node> pool, std::span<const NodeRange> levels, std::uint64_t entry_count,
             std::uint64_t long_entry_count, std::span<const gpu::BeforeChild> before,
             std::span<const gpu::uint> voxels_before_leaf, std::uint32_t entries_per_word)
        : m_pool(pool), m_levels(levels), m_entry_count(entry_count), m_long_entry_count(long_entry_count),
          m_before(before), m_voxels_before_leaf(voxels_before_leaf)
    {
        for (const NodeRange& range : levels)
            m_node_count += range.node_count;
        m_per_word = entries_per_word != 0 ? entries_per_word : entriesPerWord(m_node_count);
        m_first_index = 2 * m_node_count * m_per_word;
    }

    DagContents expand()
    {
        if (checkSizes() && !m_levels.empty())
            visit(m_levels[0].first_node, 0, 0, 0, 0);
        return std::move(m_contents);
    }

private:
    void violate(const std::string& violation)
    {
        if (m_contents.violations.size() < kViolationsMax)
            m_contents.violations.push_back(violation);
    }

    bool checkSizes()
    {
        std::uint64_t first = 0;
        bool good = true;
        for (const NodeRange& range : m_levels)
        {
            good = good && range.first_node == first;
            first += range.node_count;
        }
        good = good && (m_levels.empty() || m_levels[0].node_count == 1);
        if (!good)
            violate("levels do not follow each other from a single root on");
        const std::uint64_t list_words = (m_entry_count + m_per_word - 1) / m_per_word; // of 64 bits
        const std::uint64_t pool_nodes = m_node_count + (list_words + 1) / 2;
        if (m_pool.size() != pool_nodes || m_long_entry_count > m_entry_count)
        {
            violate("pool has " + std::to_string(m_pool.size()) + " nodes' room, not " + std::to_string(pool_nodes));
            return false;
        }
        for (std::uint64_t place = m_entry_count; place < 2 * m_per_word * (m_pool.size() - m_node_count); ++place)
            if (entryAt(m_pool, m_first_index + place, m_per_word) != 0)
                violate("entry " + std::to_string(place) + " behind the lists is not 0");
        const std::uint64_t short_words = (m_entry_count - m_long_entry_count + 1) / 2;
        m_ranked = m_before.size() == m_long_entry_count && m_voxels_before_leaf.size() == short_words;
        if (!m_ranked && !(m_before.empty() && m_voxels_before_leaf.empty()))
            violate("before or voxels_before_leaf has a wrong size");
        return good;
    }

    [[nodiscard]] std::uint64_t voxelsBeforeLeaf(std::uint64_t entry) const
    {
        const std::uint64_t i = entry - m_long_entry_count;
        return m_voxels_before_leaf[i / 2] >> (16 * (i % 2)) & 0xFFFF;
    }

    // Visits a node of a level with its Morton code; `voxels` and `nodes` are the counts before it.
    void visit(std::uint64_t index, std::size_t level, std::uint64_t code, std::uint64_t voxels, std::uint64_t nodes)
    {
        const gpu::Node& node = m_pool[index];
        const std::string name = "node " + std::to_string(index);
        m_contents.nodes.push_back({static_cast<std::uint32_t>(level), code, m_ranked ? nodes : kNoRank});
        if (maskOf(node) == 0)
            violate(name + " is empty");
        const bool leaf = level + 1 == m_levels.size();
        if (((node.base_lo & node.base_hi & gpu::kChildList) == 0) != leaf)
            violate(name + (leaf ? ", a leaf, has a list" : " has no list"));
        if (node.base_hi != node.base_lo + static_cast<std::uint32_t>(std::popcount(node.mask_lo)))
            violate(name + ": base_hi does not follow base_lo");
        std::uint64_t number = 0; // of the child in its node
        for (std::uint32_t cell = 0; cell < kCells; ++cell)
        {
            if (!hasCell(node, cell))
                continue;
            if (leaf)
                m_contents.voxels.push_back({static_cast<std::uint32_t>(m_levels.size()), code << 6 | cell,
                                             m_ranked ? voxels + placeOf(node, cell) : kNoRank});
            else
                visitChild(placeOf(node, cell), level, code << 6 | cell, number, voxels, nodes, name);
            ++number;
        }
    }

    void visitChild(std::uint64_t place, std::size_t level, std::uint64_t code, std::uint64_t number,
                    std::uint64_t voxels, std::uint64_t nodes, const std::string& parent)
    {
        const bool above_leaves = level + 2 == m_levels.size();
        const std::uint64_t first = m_first_index + (above_leaves ? m_long_entry_count : 0);
        const std::uint64_t end = m_first_index + (above_leaves ? m_entry_count : m_long_entry_count);
        if (place < first || place >= end)
        {
            violate(parent + ": list leads to place " + std::to_string(place));
            return;
        }
        const std::uint32_t child = entryAt(m_pool, place, m_per_word);
        const NodeRange& range = m_levels[level + 1];
        if (child < range.first_node || child - range.first_node >= range.node_count)
        {
            violate(parent + ": child " + std::to_string(child) + " is not of the next level");
            return;
        }
        const std::uint64_t entry = place - m_first_index;
        std::uint64_t voxels_before = 0;
        std::uint64_t nodes_before = number;
        if (m_ranked)
        {
            voxels_before = above_leaves ? voxelsBeforeLeaf(entry) : m_before[entry].voxels;
            nodes_before = above_leaves ? number : m_before[entry].nodes;
        }
        visit(child, level + 1, code, voxels + voxels_before, nodes + 1 + nodes_before);
    }

    std::span<const gpu::Node> m_pool;
    std::span<const NodeRange> m_levels;
    std::uint64_t m_entry_count;
    std::uint64_t m_long_entry_count;
    std::span<const gpu::BeforeChild> m_before;
    std::span<const gpu::uint> m_voxels_before_leaf;
    std::uint64_t m_node_count = 0;
    std::uint32_t m_per_word = 0; // entries, of 64 bits
    std::uint64_t m_first_index = 0;
    bool m_ranked = false;
    DagContents m_contents;
};

} // namespace

DagContents expandDag(std::span<const gpu::Node> pool, std::span<const NodeRange> levels, std::uint64_t entry_count,
                      std::uint64_t long_entry_count, std::span<const gpu::BeforeChild> before,
                      std::span<const gpu::uint> voxels_before_leaf, std::uint32_t entries_per_word)
{
    return Expander(pool, levels, entry_count, long_entry_count, before, voxels_before_leaf, entries_per_word).expand();
}

} // namespace zvo::oracle
