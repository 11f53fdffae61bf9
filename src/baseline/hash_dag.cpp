// SPDX-License-Identifier: MIT
#include "baseline/hash_dag.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <iterator>
#include <unordered_set>

namespace zvo::baseline
{

namespace
{

using Words = std::vector<std::uint32_t>;

// The words of a node.
std::span<const std::uint32_t> nodeAt(const Words& words, std::uint32_t first, bool is_lowest)
{
    return std::span(words).subspan(first, is_lowest ? 1U : 1U + static_cast<unsigned>(std::popcount(words[first])));
}

// Nodes of one level by what they hold. A key is the number of a node's first word.
struct NodeHash
{
    const Words* words;
    bool is_lowest;

    std::size_t operator()(std::uint32_t first) const
    {
        std::uint64_t hash = 0;
        for (const std::uint32_t word : nodeAt(*words, first, is_lowest))
        {
            hash = (hash ^ word) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 32;
        }
        return hash;
    }
};

struct NodeEqual
{
    const Words* words;
    bool is_lowest;

    bool operator()(std::uint32_t a, std::uint32_t b) const
    {
        return std::ranges::equal(nodeAt(*words, a, is_lowest), nodeAt(*words, b, is_lowest));
    }
};

using NodeTable = std::unordered_set<std::uint32_t, NodeHash, NodeEqual>;

// An occupied cell of a level: its Morton code among the level's cells, and its node.
struct Cell
{
    std::uint64_t code = 0;
    std::uint32_t node = 0;
};

// The nodes of a level from the cells inside of them, which are emptied.
std::vector<Cell> makeParents(std::vector<Cell>& cells, bool is_lowest, HashDag& dag)
{
    NodeTable table(cells.size() / 4 + 1, NodeHash{&dag.words, is_lowest}, NodeEqual{&dag.words, is_lowest});
    std::vector<Cell> nodes;
    for (std::size_t i = 0; i < cells.size();)
    {
        const std::uint64_t parent = cells[i].code / 8;
        const auto first = static_cast<std::uint32_t>(dag.words.size());
        dag.words.push_back(0);
        for (; i < cells.size() && cells[i].code / 8 == parent; ++i)
        {
            dag.words[first] |= 1U << cells[i].code % 8;
            if (!is_lowest)
            {
                dag.words.push_back(cells[i].node);
            }
        }
        const auto [found, is_new] = table.insert(first);
        if (!is_new)
        {
            dag.words.resize(first);
        }
        dag.node_count += is_new ? 1 : 0;
        nodes.push_back({parent, *found});
    }
    cells.clear();
    return nodes;
}

void appendCodes(const HashDag& dag, std::uint32_t node, std::uint32_t level, std::uint64_t code,
                 std::vector<std::uint64_t>& codes)
{
    std::uint32_t place = node + 1;
    for (std::uint32_t cells = dag.words[node]; cells != 0; cells &= cells - 1)
    {
        const std::uint64_t cell = code * 8 + static_cast<unsigned>(std::countr_zero(cells));
        if (level + 1 == dag.depth)
        {
            codes.push_back(cell);
        }
        else
        {
            appendCodes(dag, dag.words[place++], level + 1, cell, codes);
        }
    }
}

} // namespace

HashDag hashDag(std::span<const std::uint64_t> codes, std::uint32_t depth)
{
    assert(depth != 0);
    HashDag dag{.depth = depth, .words = {}, .root = 0, .node_count = 0};
    std::vector<Cell> cells;
    cells.reserve(codes.size());
    std::ranges::transform(codes, std::back_inserter(cells), [](std::uint64_t code) { return Cell{code, 0}; });
    for (std::uint32_t level = depth; level-- != 0;)
    {
        cells = makeParents(cells, level + 1 == depth, dag);
    }
    dag.root = cells.empty() ? 0 : cells.front().node;
    return dag;
}

std::vector<std::uint64_t> listCodes(const HashDag& dag)
{
    std::vector<std::uint64_t> codes;
    if (!dag.words.empty())
    {
        appendCodes(dag, dag.root, 0, 0, codes);
    }
    return codes;
}

} // namespace zvo::baseline
