// SPDX-License-Identifier: MIT
// The first half of compression: finds which nodes of a tree are equal, subtrees included. Programs use
// core/svdag/svdag_builder.h.
#pragma once

#include "core/tree/device_tree.h"
#include "svdag/svdag.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// The nodes that are compressed. tree must have levels; its nodes may be the pool of a DAG.
struct Candidates
{
    const DeviceTree& tree;
    std::uint32_t hash_mask = UINT32_MAX; // CompressOptions::hash_mask

    [[nodiscard]] const std::vector<DeviceTree::Level>& levels() const { return tree.levels; }
    [[nodiscard]] std::uint32_t count() const { return tree.node_count; }
    [[nodiscard]] std::uint32_t innerCount() const { return tree.levels.back().first_node; }

    /// From the number of a node of a level to its reference (shaders/shared/octree.h).
    [[nodiscard]] std::uint32_t reference(std::size_t level) const
    {
        return level + 1 == tree.levels.size() ? tree.leafReference() : 0;
    }

    /// From the reference of a leaf of a filled octree to that of its surface mask.
    [[nodiscard]] std::uint32_t surface() const
    {
        const std::uint64_t first_mask = tree.nodeWords() - tree.leaf_words;
        return tree.filled ? static_cast<std::uint32_t>(first_mask - 2 * std::uint64_t{tree.innerCount()}) : 0;
    }
};

/// The number of slots in the table of classes for each level: powers of two. at_first: the number for every level; 0:
/// an estimate for each.
std::vector<std::uint64_t> classSlots(const Candidates& candidates, std::uint64_t at_first);

/// The buffers for finding and numbering classes.
struct ClassBuffers
{
    ClassBuffers(vk::Device& device, const Candidates& candidates, std::span<const std::uint64_t> slot_counts);

    /// Bytes of all these buffers.
    static std::uint64_t bytes(const Candidates& candidates, std::span<const std::uint64_t> slot_counts);

    /// [slots of all levels] the root's first; in the end, the candidates of the unique nodes, by number
    vk::BufferOf<gpu::uint> table;
    vk::BufferOf<gpu::uint> classes;        // [candidates]
    vk::BufferOf<gpu::uint> numbers;        // [candidates] unique nodes before the candidate
    vk::BufferOf<gpu::uint> first_entries;  // [inner candidates] entries of lists before those of the candidate
    vk::BufferOf<gpu::uvec2> hashes;        // [inner candidates of the largest level]
    vk::BufferOf<gpu::uint> node_partials;  // [ceil(candidates / kScanBlock)]
    vk::BufferOf<gpu::uint> entry_partials; // as node_partials
    vk::BufferOf<gpu::ClassSizes> sizes;    // [1]
};

/// Records the passes that fill buffers: the classes level by level, the leaves first, then the numbers. Afterwards
/// sizes.overflow_counts tells which levels had too few slots. If any has, the other results are meaningless, but
/// within bounds. Numbers come from prefix sums over the candidates, so they do not depend on the order of threads.
/// Cost: candidates and slots.
void findClasses(vk::FrameGraph& graph, const Candidates& candidates, std::span<const std::uint64_t> slot_counts,
                 ClassBuffers& buffers);

} // namespace zvo
