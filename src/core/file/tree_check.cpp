// SPDX-License-Identifier: MIT
#include "core/file/tree_check.h"

#include "core/base/divide_up.h"
#include "core/file/attributes_check.h"
#include "core/file/tree_fault.h"

#include <bit>
#include <cmath>
#include <utility>

namespace zvo
{

namespace
{

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

void requireLevels(const TreeData& tree)
{
    const std::size_t expected = tree.nodes.empty() ? 0 : tree.grid.nodeLevels();
    requireSound(tree.levels.size() == expected, "there are {} levels of nodes where a grid of depth {} has {}",
                 tree.levels.size(), tree.grid.depth, expected);
    std::uint64_t next = 0;
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        const auto [first_node, node_count] = tree.levels[level];
        requireSound(node_count != 0 && (level != 0 || node_count == 1), "level {} has {} nodes", level, node_count);
        requireSound(first_node == next, "level {} starts at node {} and not where the level above ends, {}", level,
                     first_node, next);
        next += node_count;
    }
    requireSound(next == tree.nodes.size(), "the levels have {} nodes, but there are {}", next, tree.nodes.size());
}

void requireMasks(const TreeData& tree)
{
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    {
        const bool may_be_empty = tree.isFilled() && i != 0; // full, or a leaf without a surface
        requireSound(may_be_empty || cellMask(tree.nodes[i]) != 0, "node {} has no children", i);
    }
    const bool is_odd = tree.grid.depth % 2 != 0;
    requireSound(!is_odd || tree.nodes.empty() || cellMask(tree.nodes.front()) <= kLowerOctant,
                 "the root has children outside of the grid");
}

// Nodes of an octree have their children, and leaves their voxels, one behind the other in one sequence.
void requireOctreeNodes(const TreeData& tree)
{
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        const bool is_leaf = level + 1 == tree.levels.size();
        const char* const children = is_leaf ? "voxels" : "children";
        const auto [first_node, node_count] = tree.levels[level];
        const std::uint64_t first = is_leaf ? 0 : tree.levels[level + 1].first_node;
        const std::uint64_t end = is_leaf ? tree.voxel_count : first + tree.levels[level + 1].node_count;
        std::uint64_t next = first;
        for (std::uint32_t i = first_node; i < first_node + node_count; ++i)
        {
            const gpu::Node& node = tree.nodes[i];
            const std::uint64_t second = next + static_cast<std::uint32_t>(std::popcount(node.mask_lo));
            requireSound(node.base_lo == next && node.base_hi == second,
                         "node {} of level {} names {} and {} as its first {}, where {} and {} come next", i, level,
                         node.base_lo, node.base_hi, children, next, second);
            next += cellCount(node);
        }
        requireSound(next == end, "the nodes of level {} have {} {} in all, where there are {}", level, next - first,
                     children, end - first);
    }
}

// Nodes of a DAG have lists, one behind the other. A list names nodes of the next level that earlier lists named, or
// the one that comes next: so each is named, and in the order of the first naming.
void requireLists(const TreeData& tree, std::size_t level, std::uint64_t& next_entry)
{
    const auto [first_node, node_count] = tree.levels[level];
    const auto [first_child, child_count] = tree.levels[level + 1];
    std::uint64_t new_child = first_child;
    for (std::uint32_t i = first_node; i < first_node + node_count; ++i)
    {
        const gpu::Node& node = tree.nodes[i];
        const std::uint64_t index = tree.packing().firstEntry() + next_entry;
        const std::uint64_t second_index = index + static_cast<std::uint32_t>(std::popcount(node.mask_lo));
        requireSound(node.base_lo == (gpu::kChildList | index) && node.base_hi == (gpu::kChildList | second_index),
                     "node {} of level {} has its lists at {:#x} and {:#x}, where {:#x} and {:#x} come next", i, level,
                     node.base_lo, node.base_hi, gpu::kChildList | index, gpu::kChildList | second_index);
        const std::uint64_t end = next_entry + cellCount(node);
        requireSound(end <= tree.lists.size(), "the list of node {} ends behind all lists", i);
        for (; next_entry < end; ++next_entry)
        {
            const std::uint32_t child = tree.lists[next_entry];
            requireSound(child >= first_child && child < std::uint64_t{first_child} + child_count,
                         "entry {} of the lists names node {}, which is not in level {}", next_entry, child, level + 1);
            requireSound(child <= new_child, "entry {} of the lists names node {} before node {} was named", next_entry,
                         child, new_child);
            new_child += child == new_child ? 1 : 0;
        }
    }
    requireSound(new_child == std::uint64_t{first_child} + child_count, "nothing leads to node {} of level {}",
                 new_child, level + 1);
}

void requireDagLeaves(const TreeData& tree)
{
    const auto [first_node, node_count] = tree.levels.back();
    for (std::uint32_t i = first_node; i < first_node + node_count; ++i)
    {
        const gpu::Node& node = tree.nodes[i];
        requireSound(node.base_lo == 0 && node.base_hi == static_cast<std::uint32_t>(std::popcount(node.mask_lo)),
                     "leaf {} numbers its voxels from {} and {}", i, node.base_lo, node.base_hi);
    }
}

void requireDagNodes(const TreeData& tree)
{
    requireSound(tree.packing().fits(gpu::kChildList), "{} nodes and {} entries of lists are more than a DAG can have",
                 tree.nodes.size(), tree.lists.size());
    std::uint64_t next_entry = 0;
    std::uint64_t long_entry_count = 0;
    for (std::size_t level = 0; level + 1 < tree.levels.size(); ++level)
    {
        long_entry_count = next_entry;
        requireLists(tree, level, next_entry);
    }
    requireSound(next_entry == tree.lists.size(), "the nodes have {} entries of lists, but there are {}", next_entry,
                 tree.lists.size());
    requireSound(long_entry_count == tree.long_entry_count, "{} entries of lists are said to be long, where {} are",
                 tree.long_entry_count, long_entry_count);
    if (!tree.levels.empty())
    {
        requireDagLeaves(tree);
    }
}

// Checks the counts beside an entry: of what is below the children before it.
void requireBefore(const TreeData& tree, std::uint64_t entry, const Below& before)
{
    if (!tree.hasAttributes())
    {
        return;
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
    requireSound(equal, "the counts beside entry {} of the lists are wrong", entry);
}

// Checks totals, and the counts beside the lists, from the leaves up.
void requireDagCounts(const TreeData& tree)
{
    const std::uint64_t short_count = tree.lists.size() - tree.long_entry_count;
    const std::uint64_t long_expected = tree.hasAttributes() ? tree.long_entry_count : 0;
    const std::uint64_t words_expected = tree.hasAttributes() ? divideUp(short_count, 2) : 0;
    requireSound(tree.before.size() == long_expected && tree.voxels_before_leaf.size() == words_expected,
                 "there are {} and {} counts beside the lists, where there must be {} and {}", tree.before.size(),
                 tree.voxels_before_leaf.size(), long_expected, words_expected);
    requireSound(words_expected == 0 || short_count % 2 == 0 || tree.voxels_before_leaf.back() <= kHalfWordMask,
                 "there is something behind the last count beside the lists");
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
                    requireBefore(tree, entry, sum);
                    const Below& child = below[tree.lists[entry] - tree.levels[level + 1].first_node];
                    sum = {sum.voxels + child.voxels, sum.nodes + child.nodes};
                }
            }
            sums[i] = {sum.voxels, sum.nodes + 1};
        }
        below = std::move(sums);
    }
    const Below all = below.empty() ? Below{} : below.front();
    requireSound(all.voxels == tree.voxel_count && all.nodes == tree.octree_node_count,
                 "the nodes make {} voxels and {} octree nodes, but {} and {} are stated", all.voxels, all.nodes,
                 tree.voxel_count, tree.octree_node_count);
}

// Of a filled tree: every leaf has cells, those of the surface among them. The last sums fit, as a grid has at most
// 2^51 cells.
void requireOccupied(const TreeData& tree)
{
    const std::uint32_t leaf_count = tree.levels.size() > 1 ? tree.levels.back().node_count : 0;
    requireSound(tree.occupied.size() == leaf_count, "there are {} occupied cells' masks of {} leaves",
                 tree.occupied.size(), leaf_count);
    for (std::uint32_t i = 0; i < leaf_count; ++i)
    {
        const std::uint64_t mask = cellMask(tree.nodes[tree.levels.back().first_node + i]);
        requireSound(tree.occupied[i] != 0 && (mask & ~tree.occupied[i]) == 0,
                     "leaf {} has cells of the surface that are not occupied, or none", i);
    }
}

void requireGrid(const Grid& grid)
{
    requireSound(grid.depth >= 1 && grid.depth <= Grid::kDepthMax, "a grid of depth {}, where 1 to {} are possible",
                 grid.depth, Grid::kDepthMax);
    const glm::vec3 end = grid.origin + grid.voxel_size * static_cast<float>(grid.resolution());
    const bool finite = std::isfinite(end.x) && std::isfinite(end.y) && std::isfinite(end.z);
    requireSound(std::isnormal(grid.voxel_size) && grid.voxel_size > 0.0F && finite,
                 "the grid's corners and its voxel size are not finite numbers, the size above 0");
}

void requireTree(const TreeData& tree)
{
    requireGrid(tree.grid);
    const bool is_octree = tree.structure == TreeStructure::Svo;
    requireSound(is_octree || tree.structure == TreeStructure::Svdag, "the structure is neither an octree nor a DAG");
    requireSound(!is_octree || (tree.lists.empty() && tree.before.empty() && tree.voxels_before_leaf.empty() &&
                                tree.long_entry_count == 0 && tree.octree_node_count == tree.nodes.size()),
                 "an octree with what only a DAG has");
    requireLevels(tree);
    requireMasks(tree);
    if (is_octree)
    {
        requireOctreeNodes(tree);
        requireSound(!tree.nodes.empty() || tree.voxel_count == 0, "there are voxels without nodes");
    }
    else
    {
        requireDagNodes(tree);
        requireDagCounts(tree);
    }
    if (tree.isFilled())
    {
        requireSound(tree.levels.size() != 1, "a filled tree of one level of nodes");
        requireOccupied(tree);
    }
    requireAttributes(tree);
}

// What the check finds; nothing where it passes.
template <typename Subject> std::optional<std::string> faultOf(void (*check)(const Subject&), const Subject& subject)
{
    try
    {
        check(subject);
    }
    catch (const TreeFault& fault)
    {
        return fault.what();
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> checkGrid(const Grid& grid)
{
    return faultOf(requireGrid, grid);
}

std::optional<std::string> checkTree(const TreeData& tree)
{
    return faultOf(requireTree, tree);
}

} // namespace zvo
