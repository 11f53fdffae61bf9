// SPDX-License-Identifier: MIT
#include "core/file/tree_check.h"

#include "core/base/divide_up.h"
#include "core/file/attributes_check.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace zvo
{

namespace
{

using Fault = std::optional<std::string>;

constexpr std::uint32_t kLowerOctant = 0xffU;    // of Node::mask_lo
constexpr std::uint32_t kHalfWordMask = 0xffffU; // of voxels_before_leaf

std::uint32_t cellCount(const gpu::Node& node)
{
    return static_cast<std::uint32_t>(std::popcount(node.mask_lo) + std::popcount(node.mask_hi));
}

// The nodes and voxels of a subtree. Nine levels of 64 cells have fewer than 2^55 of either, so sums cannot overflow.
struct Below
{
    std::uint64_t voxels = 0;
    std::uint64_t nodes = 0; // the topmost included
};

Fault checkLevels(const TreeData& tree)
{
    const std::size_t expected = tree.nodes.empty() ? 0 : tree.grid.nodeLevels();
    if (tree.levels.size() != expected)
    {
        return fmt::format("there are {} levels of nodes where a grid of depth {} has {}", tree.levels.size(),
                           tree.grid.depth, expected);
    }
    std::uint64_t next = 0;
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        const auto [first_node, node_count] = tree.levels[level];
        if (node_count == 0 || (level == 0 && node_count != 1))
        {
            return fmt::format("level {} has {} nodes", level, node_count);
        }
        if (first_node != next)
        {
            return fmt::format("level {} starts at node {} and not where the level above ends, {}", level, first_node,
                               next);
        }
        next += node_count;
    }
    if (next != tree.nodes.size())
    {
        return fmt::format("the levels have {} nodes, but there are {}", next, tree.nodes.size());
    }
    return std::nullopt;
}

Fault checkMasks(const TreeData& tree)
{
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    {
        if (cellMask(tree.nodes[i]) == 0)
        {
            return fmt::format("node {} has no children", i);
        }
    }
    const bool is_odd = tree.grid.depth % 2 != 0;
    if (is_odd && !tree.nodes.empty() && cellMask(tree.nodes.front()) > kLowerOctant)
    {
        return "the root has children outside of the grid";
    }
    return std::nullopt;
}

// Nodes of an octree have their children, and leaves their voxels, one behind the other in one sequence.
Fault checkOctreeNodes(const TreeData& tree)
{
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        const bool is_leaf = level + 1 == tree.levels.size();
        const auto [first_node, node_count] = tree.levels[level];
        const std::uint64_t first = is_leaf ? 0 : tree.levels[level + 1].first_node;
        const std::uint64_t end = is_leaf ? tree.voxel_count : first + tree.levels[level + 1].node_count;
        std::uint64_t next = first;
        for (std::uint32_t i = first_node; i < first_node + node_count; ++i)
        {
            const gpu::Node& node = tree.nodes[i];
            const std::uint64_t second = next + static_cast<std::uint32_t>(std::popcount(node.mask_lo));
            if (node.base_lo != next || node.base_hi != second)
            {
                return fmt::format("node {} of level {} names {} and {} as its first {}, where {} and {} come next", i,
                                   level, node.base_lo, node.base_hi, is_leaf ? "voxels" : "children", next, second);
            }
            next += cellCount(node);
        }
        if (next != end)
        {
            return fmt::format("the nodes of level {} have {} {} in all, where there are {}", level, next - first,
                               is_leaf ? "voxels" : "children", end - first);
        }
    }
    return std::nullopt;
}

// Nodes of a DAG have lists, one behind the other. A list names nodes of the next level that earlier lists named, or
// the one that comes next: so each is named, and in the order of the first naming.
Fault checkLists(const TreeData& tree, std::size_t level, std::uint64_t& next_entry)
{
    const auto [first_node, node_count] = tree.levels[level];
    const auto [first_child, child_count] = tree.levels[level + 1];
    std::uint64_t new_child = first_child;
    for (std::uint32_t i = first_node; i < first_node + node_count; ++i)
    {
        const gpu::Node& node = tree.nodes[i];
        const std::uint64_t index = tree.packing().firstEntry() + next_entry;
        const std::uint64_t second_index = index + static_cast<std::uint32_t>(std::popcount(node.mask_lo));
        if (node.base_lo != (gpu::kChildList | index) || node.base_hi != (gpu::kChildList | second_index))
        {
            return fmt::format("node {} of level {} has its lists at {:#x} and {:#x}, where {:#x} and {:#x} come next",
                               i, level, node.base_lo, node.base_hi, gpu::kChildList | index,
                               gpu::kChildList | second_index);
        }
        const std::uint64_t end = next_entry + cellCount(node);
        if (end > tree.lists.size())
        {
            return fmt::format("the list of node {} ends behind all lists", i);
        }
        for (; next_entry < end; ++next_entry)
        {
            const std::uint32_t child = tree.lists[next_entry];
            if (child < first_child || child >= std::uint64_t{first_child} + child_count)
            {
                return fmt::format("entry {} of the lists names node {}, which is not in level {}", next_entry, child,
                                   level + 1);
            }
            if (child > new_child)
            {
                return fmt::format("entry {} of the lists names node {} before node {} was named", next_entry, child,
                                   new_child);
            }
            new_child += child == new_child ? 1 : 0;
        }
    }
    if (new_child != std::uint64_t{first_child} + child_count)
    {
        return fmt::format("nothing leads to node {} of level {}", new_child, level + 1);
    }
    return std::nullopt;
}

Fault checkDagLeaves(const TreeData& tree)
{
    const auto [first_node, node_count] = tree.levels.back();
    for (std::uint32_t i = first_node; i < first_node + node_count; ++i)
    {
        const gpu::Node& node = tree.nodes[i];
        if (node.base_lo != 0 || node.base_hi != static_cast<std::uint32_t>(std::popcount(node.mask_lo)))
        {
            return fmt::format("leaf {} numbers its voxels from {} and {}", i, node.base_lo, node.base_hi);
        }
    }
    return std::nullopt;
}

Fault checkDagNodes(const TreeData& tree)
{
    if (!tree.packing().fits())
    {
        return fmt::format("{} nodes and {} entries of lists are more than a DAG can have", tree.nodes.size(),
                           tree.lists.size());
    }
    std::uint64_t next_entry = 0;
    std::uint64_t long_entry_count = 0;
    for (std::size_t level = 0; level + 1 < tree.levels.size(); ++level)
    {
        long_entry_count = next_entry;
        if (Fault fault = checkLists(tree, level, next_entry))
        {
            return fault;
        }
    }
    if (next_entry != tree.lists.size())
    {
        return fmt::format("the nodes have {} entries of lists, but there are {}", next_entry, tree.lists.size());
    }
    if (long_entry_count != tree.long_entry_count)
    {
        return fmt::format("{} entries of lists are said to be long, where {} are", tree.long_entry_count,
                           long_entry_count);
    }
    return tree.levels.empty() ? std::nullopt : checkDagLeaves(tree);
}

// Checks the counts beside an entry: of what is below the children before it.
Fault checkBefore(const TreeData& tree, std::uint64_t entry, const Below& before)
{
    if (!tree.hasAttributes())
    {
        return std::nullopt;
    }
    bool equal = false;
    if (entry < tree.long_entry_count)
    {
        const gpu::BeforeChild& stored = tree.before[entry];
        equal = stored.voxels == before.voxels && stored.nodes == before.nodes;
    }
    else
    {
        const std::uint64_t half = entry - tree.long_entry_count;
        const std::uint32_t stored = tree.voxels_before_leaf[half / 2] >> (half % 2 * 16) & kHalfWordMask;
        equal = stored == before.voxels;
    }
    return equal ? std::nullopt : Fault(fmt::format("the counts beside entry {} of the lists are wrong", entry));
}

// Checks totals, and the counts beside the lists, from the leaves up.
Fault checkDagCounts(const TreeData& tree)
{
    const std::uint64_t short_count = tree.lists.size() - tree.long_entry_count;
    const std::uint64_t long_expected = tree.hasAttributes() ? tree.long_entry_count : 0;
    const std::uint64_t words_expected = tree.hasAttributes() ? divideUp(short_count, 2) : 0;
    if (tree.before.size() != long_expected || tree.voxels_before_leaf.size() != words_expected)
    {
        return fmt::format("there are {} and {} counts beside the lists, where there must be {} and {}",
                           tree.before.size(), tree.voxels_before_leaf.size(), long_expected, words_expected);
    }
    if (words_expected != 0 && short_count % 2 != 0 && tree.voxels_before_leaf.back() > kHalfWordMask)
    {
        return "there is something behind the last count beside the lists";
    }
    std::vector<Below> below; // of the level's nodes
    for (std::size_t level = tree.levels.size(); level-- > 0;)
    {
        std::vector<Below> sums(tree.levels[level].node_count);
        for (std::uint32_t i = 0; i < sums.size(); ++i)
        {
            const gpu::Node& node = tree.nodes[tree.levels[level].first_node + i];
            Below sum; // of the children so far
            if (level + 1 == tree.levels.size())
            {
                sum.voxels = cellCount(node);
            }
            else
            {
                const std::uint64_t first = (node.base_lo & ~gpu::kChildList) - tree.packing().firstEntry();
                for (std::uint64_t entry = first; entry < first + cellCount(node); ++entry)
                {
                    if (Fault fault = checkBefore(tree, entry, sum))
                    {
                        return fault;
                    }
                    const Below& child = below[tree.lists[entry] - tree.levels[level + 1].first_node];
                    sum = {sum.voxels + child.voxels, sum.nodes + child.nodes};
                }
            }
            sums[i] = {sum.voxels, sum.nodes + 1};
        }
        below = std::move(sums);
    }
    const Below all = below.empty() ? Below{} : below.front();
    if (all.voxels != tree.voxel_count || all.nodes != tree.octree_node_count)
    {
        return fmt::format("the nodes make {} voxels and {} octree nodes, but {} and {} are stated", all.voxels,
                           all.nodes, tree.voxel_count, tree.octree_node_count);
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> checkGrid(const Grid& grid)
{
    if (grid.depth < 1 || grid.depth > Grid::kDepthMax)
    {
        return fmt::format("a grid of depth {}, where 1 to {} are possible", grid.depth, Grid::kDepthMax);
    }
    const glm::vec3 end = grid.origin + grid.voxel_size * static_cast<float>(grid.resolution());
    const bool finite = std::isfinite(end.x) && std::isfinite(end.y) && std::isfinite(end.z);
    if (!std::isnormal(grid.voxel_size) || grid.voxel_size < 0.0F || !finite)
    {
        return "the grid's corners and its voxel size are not finite numbers, the size above 0";
    }
    return std::nullopt;
}

std::optional<std::string> checkTree(const TreeData& tree)
{
    if (Fault fault = checkGrid(tree.grid))
    {
        return fault;
    }
    if (tree.structure != TreeStructure::Svo && tree.structure != TreeStructure::Svdag)
    {
        return "the structure is neither an octree nor a DAG";
    }
    const bool is_octree = tree.structure == TreeStructure::Svo;
    if (is_octree && (!tree.lists.empty() || !tree.before.empty() || !tree.voxels_before_leaf.empty() ||
                      tree.long_entry_count != 0 || tree.octree_node_count != tree.nodes.size()))
    {
        return "an octree with what only a DAG has";
    }
    if (Fault fault = checkLevels(tree))
    {
        return fault;
    }
    if (Fault fault = checkMasks(tree))
    {
        return fault;
    }
    if (Fault fault = is_octree ? checkOctreeNodes(tree) : checkDagNodes(tree))
    {
        return fault;
    }
    if (is_octree && tree.nodes.empty() && tree.voxel_count != 0)
    {
        return "there are voxels without nodes";
    }
    if (Fault fault = is_octree ? std::nullopt : checkDagCounts(tree))
    {
        return fault;
    }
    return checkAttributes(tree);
}

} // namespace zvo
