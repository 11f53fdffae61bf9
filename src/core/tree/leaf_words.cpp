// SPDX-License-Identifier: MIT
#include "core/tree/leaf_words.h"

#include "core/base/divide_up.h"
#include "core/tree/tree_limits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace zvo
{

namespace
{

static_assert(ListPacking::kWordsOfNode * kNodesMax <= gpu::kLeafWords); // numbers of words have no flag

std::uint32_t voxelsIn(std::uint64_t mask)
{
    return static_cast<std::uint32_t>(std::popcount(mask));
}

// words: of inner nodes, and the leaf words behind them.
std::vector<gpu::uvec2> leafGroups(std::span<const std::uint64_t> words, std::uint64_t inner_count)
{
    std::vector<gpu::uvec2> groups = {firstLeafGroup(inner_count, words.size() - 2 * inner_count)};
    std::uint32_t voxels = 0;
    for (std::size_t first = 0; first < words.size(); first += gpu::kLeafGroup)
    {
        const std::uint32_t before_group = voxels;
        std::array<std::uint32_t, gpu::kLeafGroup> before{}; // behind the last leaf, as for that
        for (std::size_t i = 0; i < gpu::kLeafGroup; ++i)
        {
            const std::size_t word = first + i;
            before[i] = word < words.size() ? voxels - before_group : before[i - 1];
            voxels += word >= 2 * inner_count && word < words.size() ? voxelsIn(words[word]) : 0;
        }
        groups.emplace_back(before_group, before[2] | before[4] << gpu::kGroupShift2 | before[6] << gpu::kGroupShift3);
    }
    return groups;
}

// What leads from one numbering of leaves, and of lists, to another; modulo 2^32.
struct Shifts
{
    std::uint32_t inner = 0;   // of the bases of nodes above the parents of leaves
    std::uint32_t parents = 0; // of the bases of these parents
    std::uint32_t entries = 0; // of the entries of lists that name leaves
};

void shiftTree(std::span<const DeviceTree::Level> levels, std::uint64_t long_entry_count, const Shifts& shifts,
               std::span<gpu::Node> nodes, std::span<gpu::uint> lists)
{
    assert(!levels.empty());
    const std::size_t leaf_level = levels.size() - 1;
    for (std::size_t level = 0; level < leaf_level; ++level)
    {
        const std::uint32_t shift = level + 1 == leaf_level ? shifts.parents : shifts.inner;
        for (gpu::Node& node : nodes.subspan(levels[level].first_node, levels[level].node_count))
        {
            node.base_lo += shift;
            node.base_hi += shift;
        }
    }
    for (gpu::uint& entry : lists.subspan(std::min<std::uint64_t>(long_entry_count, lists.size())))
    {
        entry += shifts.entries;
    }
}

} // namespace

gpu::uvec2 firstLeafGroup(std::uint64_t inner_count, std::uint64_t leaf_count)
{
    const std::uint64_t pool_nodes = divideUp(2 * inner_count + leaf_count, ListPacking::kWordsOfNode);
    return {static_cast<gpu::uint>(inner_count), static_cast<gpu::uint>(inner_count + leaf_count - pool_nodes)};
}

TreePool poolOf(const TreeData& tree)
{
    TreePool pool;
    const std::uint64_t node_count = tree.nodes.size();
    pool.leaf_words = leafWordsOf(tree.levels);
    const std::uint64_t inner_count = node_count - pool.leaf_words;
    const std::uint64_t node_words = 2 * node_count - pool.leaf_words;
    const bool is_dag = tree.structure == TreeStructure::Svdag;
    const ListPacking packing = ListPacking::tightest(node_words, node_words, tree.lists.size());
    pool.entries_per_word = packing.per_word;

    std::vector<gpu::Node> inner(tree.nodes.begin(), tree.nodes.begin() + static_cast<std::ptrdiff_t>(inner_count));
    std::vector<gpu::uint> lists = tree.lists;
    if (pool.leaf_words != 0)
    {
        const auto moved = is_dag ? static_cast<std::uint32_t>(packing.firstEntry() - tree.packing().firstEntry()) : 0U;
        const auto words = static_cast<std::uint32_t>(inner_count);
        shiftTree(tree.levels, tree.long_entry_count, {moved, moved + gpu::kLeafWords + (is_dag ? 0U : words), words},
                  inner, lists);
    }
    std::vector<std::uint64_t> words = wordsOf(inner);
    for (std::uint64_t leaf = inner_count; pool.leaf_words != 0 && leaf < node_count; ++leaf)
    {
        words.push_back(cellMask(tree.nodes[leaf]));
    }
    if (pool.leaf_words != 0 && !is_dag)
    {
        pool.leaf_groups = leafGroups(words, inner_count);
    }
    std::ranges::copy(packEntries(lists, packing.per_word), std::back_inserter(words));
    pool.nodes = nodesOf(words);
    return pool;
}

void appendLeaves(std::span<const std::uint64_t> masks, TreeData& tree)
{
    std::uint32_t voxels = 0;
    tree.nodes.reserve(tree.nodes.size() + masks.size());
    for (const std::uint64_t mask : masks)
    {
        const auto mask_lo = static_cast<gpu::uint>(mask);
        const std::uint32_t first = tree.structure == TreeStructure::Svdag ? 0 : voxels;
        tree.nodes.push_back({mask_lo, first, static_cast<gpu::uint>(mask >> 32), first + voxelsIn(mask_lo)});
        voxels += voxelsIn(mask);
    }
}

void setNodes(std::span<const gpu::Node> pool, const DeviceTree& from, TreeData& tree)
{
    const std::vector<std::uint64_t> words = wordsOf(pool);
    const bool is_dag = from.isDag();
    tree.nodes.assign(pool.begin(), pool.begin() + from.innerCount());
    appendLeaves(std::span(words).subspan(2 * std::uint64_t{from.innerCount()}, from.leaf_words), tree);
    const ListPacking packing = from.packing();
    if (is_dag)
    {
        const std::span<const std::uint64_t> lists = std::span(words).subspan(packing.node_words, packing.wordCount());
        tree.lists = unpackEntries(lists, packing.entry_count, packing.per_word);
    }
    if (tree.nodes.size() > 1)
    {
        const auto moved = is_dag ? static_cast<std::uint32_t>(tree.packing().firstEntry() - packing.firstEntry()) : 0U;
        const std::uint32_t leaves = from.leaf_words != 0 ? from.innerCount() : 0;
        const std::uint32_t flag = from.leaf_words != 0 ? gpu::kLeafWords : 0;
        shiftTree(tree.levels, tree.long_entry_count, {moved, moved - flag - (is_dag ? 0U : leaves), 0U - leaves},
                  tree.nodes, tree.lists);
    }
}

} // namespace zvo
