// SPDX-License-Identifier: MIT
// The sparse voxel DAG of an octree, made with maps on the host, and the reverse: the octree that a DAG represents.
#pragma once

#include "oracle/octree_check.h"
#include "shared/svdag.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo::oracle
{

/// A DAG in the layout of shaders/shared/svdag.h.
struct ReferenceDag
{
    std::vector<gpu::Node> pool;
    std::vector<NodeRange> levels; // of unique nodes; none for an octree without nodes
    std::uint32_t node_count = 0;  // unique nodes
    std::uint32_t octree_node_count = 0;
    std::uint64_t entry_count = 0;
    std::uint64_t long_entry_count = 0;
    std::uint32_t entries_per_word = 0;        // entries in 64 bits
    std::vector<gpu::BeforeChild> before;      // [long_entry_count]
    std::vector<gpu::uint> voxels_before_leaf; // [ceil((entry_count - long_entry_count) / 2)]
    std::vector<std::uint32_t> depth_first;    // [octree_node_count] the octree's nodes in depth-first order
};

/// The list entry with this index in the pool.
std::uint32_t entryAt(std::span<const gpu::Node> pool, std::uint64_t place, std::uint32_t entries_per_word);

/// Compresses an octree that checkOctree() accepts. entries_per_word: 2 or 3, or 0 for as many as node numbers allow.
ReferenceDag referenceDag(std::span<const gpu::Node> nodes, std::span<const NodeRange> levels,
                          std::uint32_t entries_per_word = 0);

/// The pool of a DAG whose leaves are leaf words (shaders/shared/svdag.h), of which there are none if the root is a
/// leaf.
struct LeafWordPool
{
    std::vector<gpu::Node> nodes;
    std::uint32_t leaf_words = 0;
    std::uint32_t entries_per_word = 0; // entries in 64 bits
};

/// entries_per_word: 2 or 3, or 0 for as many as the numbers of words allow.
LeafWordPool leafWordPool(const ReferenceDag& dag, std::uint32_t entries_per_word);

constexpr std::uint64_t kNoRank = ~std::uint64_t{0};

/// A voxel or a node of the octree that a DAG represents.
struct DagNode
{
    std::uint32_t level = 0; // of a node; the number of levels for a voxel
    std::uint64_t code = 0;  // Morton code among the cells of its level
    std::uint64_t rank = 0;  // sum along its path: of voxels in Morton order, of nodes depth first

    friend bool operator==(const DagNode&, const DagNode&) = default;
};

struct DagContents
{
    std::vector<DagNode> voxels;         // in Morton order
    std::vector<DagNode> nodes;          // depth first
    std::vector<std::string> violations; // empty: the DAG is valid by shaders/shared/svdag.h. At most kViolationsMax
};

/// Walks all paths of a DAG from its root. Children must be nodes of the next level; others are reported as violations
/// and skipped. Ranks come from before and voxels_before_leaf; they are kNoRank if both are empty although there are
/// entries. pool holds the nodes of all levels and, behind them, entry_count entries, of which long_entry_count are
/// long. entries_per_word: entries in 64 bits, or 0 as above.
DagContents expandDag(std::span<const gpu::Node> pool, std::span<const NodeRange> levels, std::uint64_t entry_count,
                      std::uint64_t long_entry_count, std::span<const gpu::BeforeChild> before,
                      std::span<const gpu::uint> voxels_before_leaf, std::uint32_t entries_per_word = 0);

} // namespace zvo::oracle
