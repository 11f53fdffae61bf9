// SPDX-License-Identifier: MIT
// The usual way to a DAG on the host: nodes of 2x2x2 cells, equal ones found by a hash table (V. Kaempe, E. Sintorn,
// U. Assarsson, High Resolution Sparse Voxel DAGs, 2013, whose levels are sorted instead).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace zvo::baseline
{

/// A DAG of nodes of 2x2x2 cells. A node is a word with a bit for each occupied cell, then the number of the first word
/// of each occupied cell's node, by ascending cell. Cells of the lowest nodes are voxels: these nodes have no numbers.
struct HashDag
{
    std::uint32_t depth = 0; // of the grid
    std::vector<std::uint32_t> words;
    std::uint32_t root = 0; // its first word; without voxels, words is empty
    std::uint64_t node_count = 0;

    [[nodiscard]] std::uint64_t bytes() const { return words.size() * sizeof(std::uint32_t); }
};

/// Builds the DAG of voxels, bottom-up, on one thread. codes: Morton codes, ascending, each once; depth: at least 1.
/// Cost: nodes of the octree.
HashDag hashDag(std::span<const std::uint64_t> codes, std::uint32_t depth);

/// The Morton codes of all voxels, ascending.
std::vector<std::uint64_t> listCodes(const HashDag& dag);

} // namespace zvo::baseline
