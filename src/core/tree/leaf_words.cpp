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

// leaves: whose leaf words stand behind so many inner nodes.
std::vector<gpu::uvec2> leafGroups(std::span<const gpu::Node> leaves, std::uint64_t inner_count, bool is_filled)
{
    const std::size_t word_count = 2 * inner_count + leaves.size();
    const std::uint64_t surface = firstFullNode(inner_count, leaves.size()) + gpu::kFullNodeCount - inner_count;
    std::vector<gpu::uvec2> groups = {firstLeafGroup(inner_count, leaves.size(), is_filled),
                                      {is_filled ? static_cast<gpu::uint>(surface) : 0U, 0U}};
    std::uint32_t voxels = 0;
    for (std::size_t first = 0; first < word_count; first += gpu::kLeafGroup)
    {
        const std::uint32_t before_group = voxels;
        std::array<std::uint32_t, gpu::kLeafGroup> before{}; // behind the last leaf, as for that
        for (std::size_t i = 0; i < gpu::kLeafGroup; ++i)
        {
            const std::size_t word = first + i;
            before[i] = word < word_count ? voxels - before_group : before[i - 1];
            voxels +=
                word >= 2 * inner_count && word < word_count ? voxelsIn(cellMask(leaves[word - 2 * inner_count])) : 0;
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

// In a filled DAG, entries that name leaves have twice their numbers: those of the words.
void nameLeafWords(std::span<gpu::uint> lists, std::uint64_t long_entry_count)
{
    std::ranges::for_each(lists.subspan(long_entry_count), [](gpu::uint& entry) { entry *= 2; });
}

// The pool of a filled DAG: the same as the TreeData's nodes and lists, with a full node and its list.
TreePool filledDagPool(const TreeData& tree)
{
    TreePool pool;
    pool.leaf_words = leafWordsOf(tree.levels);
    const std::uint64_t node_words = 2 * (tree.nodes.size() + 1);
    const ListPacking packing = ListPacking::tightest(node_words, node_words, gpu::kFullEntries + tree.lists.size());
    pool.entries_per_word = packing.per_word;
    if (!packing.fits(gpu::kLeafWords))
    {
        throwUncountable("words of nodes");
    }
    const auto full_base = gpu::kChildList | static_cast<gpu::uint>(packing.firstEntry());
    const auto moved = static_cast<gpu::uint>(packing.firstEntry() + gpu::kFullEntries - tree.packing().firstEntry());

    pool.nodes = tree.nodes;
    std::vector<gpu::uint> lists(gpu::kFullEntries, static_cast<gpu::uint>(tree.nodes.size()));
    lists.insert(lists.end(), tree.lists.begin(), tree.lists.end());
    shiftTree(tree.levels, lists.size(), {moved, moved + gpu::kLeafWords, 0}, pool.nodes, lists);
    nameLeafWords(lists, gpu::kFullEntries + tree.long_entry_count);
    const gpu::Node full = {~0U, full_base, ~0U, full_base + 32};
    const std::uint64_t inner_count = tree.nodes.size() - pool.leaf_words;
    for (std::uint64_t i = 0; i < tree.nodes.size(); ++i)
    {
        gpu::Node& node = pool.nodes[i];
        if (i < inner_count)
        {
            node = cellMask(node) == 0 ? full : node;
            continue;
        }
        const std::uint64_t occupied = tree.occupied[i - inner_count];
        node = {static_cast<gpu::uint>(occupied), static_cast<gpu::uint>(occupied >> 32), node.mask_lo, node.mask_hi};
    }
    pool.nodes.push_back(full);
    std::ranges::copy(nodesOf(packEntries(lists, packing.per_word)), std::back_inserter(pool.nodes));
    return pool;
}

// Sets the bases of full nodes of a DAG, whose masks are empty: their lists would come where those before end.
void setFullListBases(TreeData& tree)
{
    std::uint64_t next = tree.packing().firstEntry();
    for (gpu::Node& node : std::span(tree.nodes).first(tree.levels.back().first_node))
    {
        const gpu::uint base = gpu::kChildList | static_cast<gpu::uint>(next);
        node = cellMask(node) == 0 ? gpu::Node{0, base, 0, base} : node;
        next += voxelsIn(cellMask(node));
    }
}

// Sets the nodes and lists of a tree from the words of the pool of a filled DAG.
void setFilledDag(std::span<const std::uint64_t> words, const DeviceTree& from, TreeData& tree)
{
    const ListPacking packing = from.packing();
    const auto full_base = gpu::kChildList | static_cast<gpu::uint>(packing.firstEntry());
    std::ranges::replace_if(
        tree.nodes, [&](const gpu::Node& node) { return node.base_lo == full_base; }, gpu::Node{});
    tree.interior_count = from.interior_count;
    std::vector<std::uint64_t> surfaces;
    for (std::uint64_t leaf = from.innerCount(); leaf < from.node_count; ++leaf)
    {
        tree.occupied.push_back(words[2 * leaf]);
        surfaces.push_back(words[2 * leaf + 1]);
    }
    appendLeaves(surfaces, tree);
    const std::vector<gpu::uint> lists =
        unpackEntries(words.subspan(packing.node_words, packing.wordCount()), packing.entry_count, packing.per_word);
    tree.lists.assign(lists.begin() + gpu::kFullEntries, lists.end());
    for (gpu::uint& entry : std::span(tree.lists).subspan(tree.long_entry_count))
    {
        entry /= 2;
    }
    const auto moved = static_cast<gpu::uint>(tree.packing().firstEntry() - packing.firstEntry() - gpu::kFullEntries);
    shiftTree(tree.levels, tree.lists.size(), {moved, moved - gpu::kLeafWords, 0}, tree.nodes, tree.lists);
    setFullListBases(tree);
}

// Sets the bases of full nodes, whose masks are empty: their children would come where those of the nodes before end.
void setFullBases(TreeData& tree)
{
    for (std::size_t level = 0; level + 1 < tree.levels.size(); ++level)
    {
        gpu::uint next = tree.levels[level + 1].first_node;
        for (gpu::Node& node :
             std::span(tree.nodes).subspan(tree.levels[level].first_node, tree.levels[level].node_count))
        {
            node = cellMask(node) == 0 ? gpu::Node{0, next, 0, next} : node;
            next += voxelsIn(cellMask(node));
        }
    }
}

} // namespace

std::uint32_t firstFullNode(std::uint64_t inner_count, std::uint64_t leaf_count)
{
    return static_cast<std::uint32_t>(divideUp(2 * inner_count + leaf_count, ListPacking::kWordsOfNode));
}

std::uint64_t poolNodes(std::uint64_t inner_count, std::uint64_t leaf_count, bool filled)
{
    const std::uint64_t behind_leaves = gpu::kFullNodeCount + divideUp(leaf_count, ListPacking::kWordsOfNode);
    return firstFullNode(inner_count, leaf_count) + (filled ? behind_leaves : 0);
}

gpu::uvec2 firstLeafGroup(std::uint64_t inner_count, std::uint64_t leaf_count, bool filled)
{
    const std::uint64_t behind = poolNodes(inner_count, leaf_count, filled);
    return {static_cast<gpu::uint>(inner_count), static_cast<gpu::uint>(inner_count + leaf_count - behind)};
}

TreePool poolOf(const TreeData& tree)
{
    if (tree.isFilled() && tree.structure == TreeStructure::Svdag)
    {
        return filledDagPool(tree);
    }
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
    const std::uint32_t first_full = firstFullNode(inner_count, pool.leaf_words);
    const gpu::Node full = {~0U, gpu::kFullNodes | first_full, ~0U, (gpu::kFullNodes | first_full) + 32};
    std::ranges::replace_if(
        inner, [](const gpu::Node& node) { return cellMask(node) == 0; }, full);
    std::vector<std::uint64_t> words = wordsOf(inner);
    const std::span<const gpu::Node> leaves = std::span(tree.nodes).last(pool.leaf_words);
    const auto append_masks = [&] { std::ranges::transform(leaves, std::back_inserter(words), cellMask); };
    if (tree.isFilled())
    {
        words.insert(words.end(), tree.occupied.begin(), tree.occupied.end());
        const std::vector<gpu::Node> full_nodes(gpu::kFullNodeCount, full);
        words.resize(ListPacking::kWordsOfNode * std::size_t{first_full}, 0);
        std::ranges::copy(wordsOf(full_nodes), std::back_inserter(words));
    }
    append_masks();
    if (pool.leaf_words != 0 && !is_dag)
    {
        pool.leaf_groups = leafGroups(leaves, inner_count, tree.isFilled());
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
    if (is_dag && from.filled)
    {
        setFilledDag(words, from, tree);
        return;
    }
    std::ranges::replace_if(
        tree.nodes, [&](const gpu::Node& node) { return from.filled && (node.base_lo & gpu::kFullNodes) != 0; },
        gpu::Node{});
    const std::span<const std::uint64_t> masks =
        std::span(words).subspan(2 * std::uint64_t{from.innerCount()}, from.leaf_words);
    if (from.filled)
    {
        tree.occupied.assign(masks.begin(), masks.end());
        tree.interior_count = from.interior_count;
        appendLeaves(std::span(words).subspan(from.nodeWords() - from.leaf_words, from.leaf_words), tree);
    }
    else
    {
        appendLeaves(masks, tree);
    }
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
    if (from.filled)
    {
        setFullBases(tree);
    }
}

} // namespace zvo
