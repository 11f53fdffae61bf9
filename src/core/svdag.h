// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree.h"
#include "core/svdag_lists.h"
#include "shared/svdag.h"
#include "vk/buffer.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// A sparse voxel DAG in device memory; shaders/shared/svdag.h documents its layout.
struct Svdag
{
    /// nodes: the pool, as many elements as it takes. node_count and levels: of the nodes in it. voxel_count,
    /// voxel_attributes and emission: of the octree. node_attributes: of all nodes of the octree, depth first, a node
    /// before its children, those in Morton order.
    Octree tree;

    std::uint32_t octree_node_count = 0;
    std::uint64_t entry_count = 0;              // of lists
    std::uint32_t entries_per_word = 2;         // of 64 bits; as many as ListPacking::tightest for what compress makes
    std::uint64_t long_entry_count = 0;         // of nodes above the parents of leaves
    vk::BufferOf<gpu::BeforeChild> before;      // [long_entry_count], or empty without attributes
    vk::BufferOf<gpu::uint> voxels_before_leaf; // [ceil((entry_count - long_entry_count) / 2)], likewise

    [[nodiscard]] ListPacking packing() const { return {tree.node_count, entry_count, entries_per_word}; }

    /// Bytes of nodes and lists; and of what stands beside the lists, so that voxels find their attributes.
    [[nodiscard]] std::uint64_t geometryBytes() const { return tree.geometryBytes() + packing().bytes(); }
    [[nodiscard]] std::uint64_t rankBytes() const { return before.bytes() + voxels_before_leaf.bytes(); }
};

/// What ranks in dag, which has attributes, are summed up from; pass reads it.
gpu::RankSource rankSource(vk::Pass& pass, const Svdag& dag);

/// How an octree is compressed.
struct CompressOptions
{
    std::uint64_t table_slots = 0; // of each level's table of classes at first; 0: as many as are likely to suffice
    bool ranks = false;            // before and voxels_before_leaf even without attributes
    // For tests: entries of a word of lists, at most (0: as many as fit), and bits of inner nodes' hashes: with fewer,
    // different nodes collide.
    std::uint32_t entries_per_word = 0;
    std::uint32_t hash_mask = UINT32_MAX;
};

/// A DAG and how it came about.
struct CompressResult
{
    Svdag dag;
    std::vector<vk::PassTime> passes;            // of the runs that succeeded
    std::vector<std::uint32_t> candidate_counts; // nodes that were compressed, by level, the root first
    std::uint32_t retry_count = 0;               // runs that were thrown away because a table was too small

    /// GPU time of all passes.
    [[nodiscard]] double ms() const;
};

/// Makes a DAG of octree, which needs its levels: on the device, from the leaves up (V. Kaempe, E. Sintorn,
/// U. Assarsson, High Resolution Sparse Voxel DAGs, 2013; by hash tables in place of sorting). Voxels keep their
/// attributes; those of nodes are put in depth-first order. An octree without nodes gives a DAG without. Waits to
/// learn sizes; where a table turns out too small it grows, and the run is repeated. Throws Error{Memory} when the
/// device's budget does not suffice, or for nodes and lists of about 2^29 words and more, and Error{Other} should the
/// hashes of hundreds of different nodes be equal. Cost: nodes of the octree.
CompressResult compress(vk::HeadlessDevice& device, Octree octree, const CompressOptions& options = {});

/// The same for a DAG in which equal nodes stand several times, such as several DAGs below common nodes. Nodes of a
/// level may stand in any order, which decides their order in the result, and their children be listed or direct.
/// Attributes are already as they are to be: they only move over.
CompressResult compress(vk::HeadlessDevice& device, Svdag dag, const CompressOptions& options = {});

} // namespace zvo
