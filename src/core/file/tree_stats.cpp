// SPDX-License-Identifier: MIT
#include "core/file/tree_stats.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <span>

namespace zvo
{

namespace
{

constexpr std::uint32_t kOctants = 8;
constexpr std::uint32_t kCellsOfOctant = 8;

std::uint32_t octantMask(std::uint64_t mask, std::uint32_t octant)
{
    return static_cast<std::uint32_t>(mask >> (kCellsOfOctant * octant)) & 0xffU;
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value)
{
    constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15U; // 2^64 divided by the golden ratio
    hash = (hash ^ value) * kOdd;
    return hash ^ (hash >> 29);
}

// Numbers for things of equal content, in the order of their first occurrence; things have numbers of their own.
class Classes
{
public:
    explicit Classes(std::uint64_t thing_count)
        : m_slots(std::bit_ceil(std::max<std::uint64_t>(2 * thing_count, kSlotsMin)), kEmpty)
    {
    }

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(m_things.size()); }

    // The class of thing: a new one unless equal() holds for it and the first thing of an old one.
    template <typename Equal> std::uint32_t classOf(std::uint64_t thing, std::uint64_t hash, const Equal& equal)
    {
        const std::uint64_t last = m_slots.size() - 1;
        for (std::uint64_t at = hash & last;; at = (at + 1) & last) // half of the slots stay empty
        {
            if (m_slots[at] == kEmpty)
            {
                m_slots[at] = count();
                m_things.push_back(thing);
                return m_slots[at];
            }
            if (equal(m_things[m_slots[at]]))
            {
                return m_slots[at];
            }
        }
    }

private:
    static constexpr std::uint32_t kEmpty = UINT32_MAX;
    static constexpr std::uint64_t kSlotsMin = 2;

    std::vector<std::uint32_t> m_slots;
    std::vector<std::uint64_t> m_things; // the first of each class
};

// The classes of one level's nodes and of their octants, from those of the level below.
class LevelClasses
{
public:
    LevelClasses(const TreeData& tree, std::size_t level, std::span<const std::uint32_t> below)
        : m_tree(tree), m_first_node(tree.levels[level].first_node), m_below(below),
          m_first_child(below.empty() ? 0 : tree.levels[level + 1].first_node)
    {
    }

    // Of each node; unique_count gets how many there are.
    std::vector<std::uint32_t> ofNodes(std::uint32_t node_count, std::uint64_t& unique_count)
    {
        Classes classes(node_count);
        std::vector<std::uint32_t> of_nodes(node_count);
        for (std::uint32_t i = 0; i < node_count; ++i)
        {
            const std::uint64_t mask = maskOf(i);
            const auto count = static_cast<std::uint32_t>(std::popcount(mask));
            of_nodes[i] = classes.classOf(i, mixed(hashOf(mask, i, 0, count), occupiedOf(i)),
                                          [&](std::uint64_t other) {
                                              return maskOf(other) == mask && occupiedOf(other) == occupiedOf(i) &&
                                                     sameChildren(other, 0, i, 0, count);
                                          });
        }
        unique_count = classes.count();
        return of_nodes;
    }

    // Different octants of the nodes that are the first of their class.
    std::uint64_t uniqueOctants(std::span<const std::uint32_t> of_nodes)
    {
        std::vector<std::uint32_t> firsts;
        std::uint64_t octant_count = 0;
        for (std::uint32_t i = 0; i < of_nodes.size(); ++i)
        {
            if (of_nodes[i] == firsts.size())
            {
                firsts.push_back(i);
                octant_count += octantCount(maskOf(i));
            }
        }
        Classes classes(octant_count);
        for (const std::uint32_t node : firsts)
        {
            const std::uint64_t mask = maskOf(node);
            std::uint32_t rank = 0;
            for (std::uint32_t octant = 0; octant < kOctants; ++octant)
            {
                const std::uint32_t cells = octantMask(mask, octant);
                const auto count = static_cast<std::uint32_t>(std::popcount(cells));
                if (count == 0)
                {
                    continue;
                }
                const auto equal = [&](std::uint64_t thing)
                {
                    const std::uint64_t other = thing / kOctants;
                    const auto other_octant = static_cast<std::uint32_t>(thing % kOctants);
                    return octantMask(maskOf(other), other_octant) == cells &&
                           sameChildren(other, rankBefore(maskOf(other), other_octant), node, rank, count);
                };
                classes.classOf(std::uint64_t{node} * kOctants + octant, hashOf(cells, node, rank, count), equal);
                rank += count;
            }
        }
        return classes.count();
    }

    static std::uint32_t octantCount(std::uint64_t mask)
    {
        std::uint32_t count = 0;
        for (std::uint32_t octant = 0; octant < kOctants; ++octant)
        {
            count += octantMask(mask, octant) != 0 ? 1 : 0;
        }
        return count;
    }

private:
    [[nodiscard]] const gpu::Node& node(std::uint64_t index) const { return m_tree.nodes[m_first_node + index]; }
    [[nodiscard]] std::uint64_t maskOf(std::uint64_t index) const { return cellMask(node(index)); }
    // Of a leaf of a filled tree; else 0.
    [[nodiscard]] std::uint64_t occupiedOf(std::uint64_t index) const
    {
        return m_below.empty() && m_tree.isFilled() ? m_tree.occupied[index] : 0;
    }

    static std::uint32_t rankBefore(std::uint64_t mask, std::uint32_t octant)
    {
        const std::uint64_t lower = (std::uint64_t{1} << (kCellsOfOctant * octant)) - 1;
        return static_cast<std::uint32_t>(std::popcount(mask & lower));
    }

    [[nodiscard]] std::uint32_t childClass(std::uint64_t index, std::uint32_t rank) const
    {
        return m_below[m_tree.child(node(index), rank) - m_first_child];
    }

    // The rank-th to (rank + count - 1)-th children of a node; leaves have none.
    [[nodiscard]] std::uint64_t hashOf(std::uint64_t cells, std::uint64_t index, std::uint32_t rank,
                                       std::uint32_t count) const
    {
        std::uint64_t hash = mixed(0, cells);
        for (std::uint32_t i = 0; i < count && !m_below.empty(); ++i)
        {
            hash = mixed(hash, childClass(index, rank + i));
        }
        return mixed(hash, hash >> 32);
    }

    [[nodiscard]] bool sameChildren(std::uint64_t a, std::uint32_t rank_a, std::uint64_t b, std::uint32_t rank_b,
                                    std::uint32_t count) const
    {
        for (std::uint32_t i = 0; i < count && !m_below.empty(); ++i)
        {
            if (childClass(a, rank_a + i) != childClass(b, rank_b + i))
            {
                return false;
            }
        }
        return true;
    }

    const TreeData& m_tree;
    std::uint32_t m_first_node;
    std::span<const std::uint32_t> m_below; // empty for leaves
    std::uint32_t m_first_child;
};

// How many nodes of the binary octree there are: each node of the tree, and each octant in it that is not empty, as
// often as the octree has it.
std::uint64_t binaryNodeCount(const TreeData& tree)
{
    std::uint64_t count = 0;
    std::vector<std::uint64_t> uses = {1}; // of the level's nodes
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        const bool is_leaf = level + 1 == tree.levels.size();
        std::vector<std::uint64_t> uses_below(is_leaf ? 0 : tree.levels[level + 1].node_count);
        for (std::uint32_t i = 0; i < tree.levels[level].node_count; ++i)
        {
            const gpu::Node& node = tree.nodes[tree.levels[level].first_node + i];
            const std::uint64_t mask = cellMask(node);
            count += uses[i] * (1 + LevelClasses::octantCount(mask));
            const auto child_count = is_leaf ? 0U : static_cast<std::uint32_t>(std::popcount(mask));
            for (std::uint32_t rank = 0; rank < child_count; ++rank)
            {
                uses_below[tree.child(node, rank) - tree.levels[level + 1].first_node] += uses[i];
            }
        }
        uses = std::move(uses_below);
    }
    return count;
}

} // namespace

TreeStats treeStats(const TreeData& tree)
{
    TreeStats stats;
    if (tree.nodes.empty())
    {
        return stats;
    }
    std::vector<std::uint32_t> below;
    for (std::size_t level = tree.levels.size(); level-- > 0;)
    {
        LevelClasses classes(tree, level, below);
        std::uint64_t unique_count = 0;
        std::vector<std::uint32_t> of_nodes = classes.ofNodes(tree.levels[level].node_count, unique_count);
        stats.unique_per_level.insert(stats.unique_per_level.begin(), unique_count);
        stats.binary_unique_count += unique_count + classes.uniqueOctants(of_nodes);
        below = std::move(of_nodes);
    }
    stats.binary_node_count = binaryNodeCount(tree);
    if (tree.grid.depth % 2 != 0) // the grid is the root's one octant
    {
        --stats.binary_node_count;
        --stats.binary_unique_count;
    }
    return stats;
}

} // namespace zvo
