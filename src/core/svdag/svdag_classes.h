// SPDX-License-Identifier: MIT
// Which nodes of a tree are equal, subtrees included: the first half of compression. Programs use
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

/// The nodes that are compressed. tree has levels; its nodes may be a DAG's pool.
struct Candidates
{
    const DeviceTree& tree;
    std::uint32_t hash_mask = UINT32_MAX; // CompressOptions::hash_mask

    [[nodiscard]] const std::vector<DeviceTree::Level>& levels() const { return tree.levels; }
    [[nodiscard]] std::uint32_t count() const { return tree.node_count; }
    [[nodiscard]] std::uint32_t innerCount() const { return tree.levels.back().first_node; }
};

/// Slots of the table of classes for each level: powers of two. at_first: for all of them; 0: as many as are likely to
/// suffice.
std::vector<std::uint64_t> classSlots(const Candidates& candidates, std::uint64_t at_first);

/// What finding and numbering classes takes. slot_counts: [levels].
struct ClassBuffers
{
    ClassBuffers(vk::Device& device, const Candidates& candidates, std::span<const std::uint64_t> slot_counts);

    /// Of all of them.
    static std::uint64_t bytes(const Candidates& candidates, std::span<const std::uint64_t> slot_counts);

    vk::BufferOf<gpu::uint> table;          // [slots of all levels] the root's first. Then: unique nodes, by number
    vk::BufferOf<gpu::uint> classes;        // [candidates]
    vk::BufferOf<gpu::uint> numbers;        // [candidates] unique nodes before
    vk::BufferOf<gpu::uint> first_entries;  // [inner candidates] entries before
    vk::BufferOf<gpu::uvec2> hashes;        // [inner candidates of the largest level]
    vk::BufferOf<gpu::uint> node_partials;  // [ceil(candidates / kScanBlock)]
    vk::BufferOf<gpu::uint> entry_partials; // likewise
    vk::BufferOf<gpu::ClassSizes> sizes;    // [1]
};

/// Records the passes that fill buffers: classes level by level, the leaves first, then numbers. Of sizes, overflows
/// tells which levels had too few slots; unless all are 0, the rest is worthless, though in bounds. Cost: candidates,
/// and slots. Numbers come from prefix sums over the candidates: they do not depend on the order of threads.
void findClasses(vk::FrameGraph& graph, const Candidates& candidates, std::span<const std::uint64_t> slot_counts,
                 ClassBuffers& buffers);

} // namespace zvo
