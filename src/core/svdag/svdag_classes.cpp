// SPDX-License-Identifier: MIT
#include "core/svdag/svdag_classes.h"

#include "core/base/divide_up.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <numeric>

namespace zvo
{

namespace
{

std::uint64_t hashCount(const Candidates& candidates)
{
    std::uint64_t count = 0;
    for (std::size_t level = 0; level + 1 < candidates.levels().size(); ++level)
    {
        count = std::max<std::uint64_t>(count, candidates.levels()[level].node_count);
    }
    return count;
}

std::uint64_t slotTotal(std::span<const std::uint64_t> slot_counts)
{
    return std::accumulate(slot_counts.begin(), slot_counts.end(), std::uint64_t{0});
}

std::uint64_t blockCount(const Candidates& candidates)
{
    return divideUp(candidates.count(), gpu::kScanBlock);
}

void findClassesOf(vk::FrameGraph& graph, const Candidates& candidates, std::size_t level,
                   std::span<const std::uint64_t> slot_counts, ClassBuffers& buffers)
{
    const bool are_leaves = level + 1 == candidates.levels().size();
    const auto [first_node, node_count] = candidates.levels()[level];
    const std::uint32_t per_word = candidates.tree.entriesPerWord();
    if (!are_leaves)
    {
        vk::Pass pass = graph.addPass(gpu::svdag::Hash{.entries_per_word = per_word});
        pass.dispatch(node_count, {.nodes = pass.read(candidates.tree.nodes),
                                   .classes = pass.read(buffers.classes),
                                   .hashes = pass.write(buffers.hashes),
                                   .first_node = first_node,
                                   .node_count = node_count,
                                   .hash_mask = candidates.hash_mask,
                                   .child_reference = candidates.reference(level + 1)});
    }
    {
        vk::Pass pass = graph.addPass(
            gpu::svdag::Insert{.entries_per_word = per_word, .leaves = are_leaves, .filled = candidates.tree.filled});
        pass.dispatch(node_count, {.nodes = pass.read(candidates.tree.nodes),
                                   .hashes = pass.read(buffers.hashes),
                                   .classes = pass.readWrite(buffers.classes),
                                   .table = pass.readWrite(buffers.table),
                                   .sizes = pass.readWrite(buffers.sizes),
                                   .first_node = first_node,
                                   .node_count = node_count,
                                   .first_slot = static_cast<std::uint32_t>(slotTotal(slot_counts.first(level))),
                                   .slot_mask = static_cast<std::uint32_t>(slot_counts[level] - 1),
                                   .level = static_cast<std::uint32_t>(level),
                                   .reference = candidates.reference(level),
                                   .child_reference = candidates.reference(level + 1),
                                   .surface = candidates.surface()});
    }
    vk::Pass pass = graph.addPass(gpu::svdag::Resolve{});
    const gpu::ClassResolveParams params = {pass.readWrite(buffers.classes), pass.read(buffers.table), first_node,
                                            node_count};
    pass.dispatch(node_count, params);
}

void scan(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& partials, vk::BufferOf<gpu::ClassSizes>& sizes,
          std::size_t total_offset)
{
    vk::Pass pass = graph.addPass(gpu::octree::Scan{});
    const gpu::ScanParams params = {pass.readWrite(partials),
                                    {pass.readWrite(sizes).address + total_offset},
                                    static_cast<std::uint32_t>(partials.count())};
    pass.dispatch(gpu::kScanGroup, params);
}

void numberClasses(vk::FrameGraph& graph, const Candidates& candidates, ClassBuffers& buffers)
{
    const std::uint64_t threads = divideUp(candidates.count(), gpu::kScanItems);
    {
        vk::Pass pass = graph.addPass(gpu::svdag::Count{.entries_per_word = candidates.tree.entriesPerWord()});
        pass.dispatch(threads, {.nodes = pass.read(candidates.tree.nodes),
                                .classes = pass.read(buffers.classes),
                                .node_partials = pass.write(buffers.node_partials),
                                .entry_partials = pass.write(buffers.entry_partials),
                                .node_count = candidates.count(),
                                .inner_count = candidates.innerCount()});
    }
    scan(graph, buffers.node_partials, buffers.sizes, offsetof(gpu::ClassSizes, node_count));
    scan(graph, buffers.entry_partials, buffers.sizes, offsetof(gpu::ClassSizes, entry_count));
    vk::Pass pass = graph.addPass(gpu::svdag::Number{.entries_per_word = candidates.tree.entriesPerWord()});
    pass.dispatch(threads, {.nodes = pass.read(candidates.tree.nodes),
                            .classes = pass.read(buffers.classes),
                            .node_partials = pass.read(buffers.node_partials),
                            .entry_partials = pass.read(buffers.entry_partials),
                            .numbers = pass.write(buffers.numbers),
                            .first_entries = pass.write(buffers.first_entries),
                            .unique_nodes = pass.write(buffers.table),
                            .node_count = candidates.count(),
                            .inner_count = candidates.innerCount()});
}

} // namespace

std::vector<std::uint64_t> classSlots(const Candidates& candidates, std::uint64_t at_first)
{
    std::vector<std::uint64_t> counts;
    for (const DeviceTree::Level& level : candidates.levels())
    {
        // A third stays free even where all nodes differ: rarely too few, and few probes.
        const std::uint64_t likely = std::uint64_t{level.node_count} + level.node_count / 2;
        counts.push_back(std::bit_ceil(at_first == 0 ? likely : at_first));
    }
    return counts;
}

ClassBuffers::ClassBuffers(vk::Device& device, const Candidates& candidates, std::span<const std::uint64_t> slot_counts)
    : table(device, "svdag/table", slotTotal(slot_counts)), classes(device, "svdag/classes", candidates.count()),
      numbers(device, "svdag/numbers", candidates.count()),
      first_entries(device, "svdag/first_entries", candidates.innerCount()),
      hashes(device, "svdag/hashes", hashCount(candidates)),
      node_partials(device, "svdag/node_partials", blockCount(candidates)),
      entry_partials(device, "svdag/entry_partials", blockCount(candidates)), sizes(device, "svdag/sizes", 1)
{
}

std::uint64_t ClassBuffers::bytes(const Candidates& candidates, std::span<const std::uint64_t> slot_counts)
{
    const std::uint64_t words = slotTotal(slot_counts) + 2 * std::uint64_t{candidates.count()} +
                                candidates.innerCount() + 2 * blockCount(candidates);
    return words * sizeof(gpu::uint) + hashCount(candidates) * sizeof(gpu::uvec2) + sizeof(gpu::ClassSizes);
}

void findClasses(vk::FrameGraph& graph, const Candidates& candidates, std::span<const std::uint64_t> slot_counts,
                 ClassBuffers& buffers)
{
    assert(slot_counts.size() == candidates.levels().size());
    graph.fill(buffers.table, gpu::kEmptySlot);
    graph.fill(buffers.sizes, 0);
    for (std::size_t level = candidates.levels().size(); level-- > 0;)
    {
        findClassesOf(graph, candidates, level, slot_counts, buffers);
    }
    numberClasses(graph, candidates, buffers);
    // The first node of a level is the first of its class.
    for (std::size_t level = 0; level < candidates.levels().size(); ++level)
    {
        constexpr std::uint64_t kWord = sizeof(gpu::uint);
        const std::uint64_t first_node = candidates.levels()[level].first_node;
        graph.copy(buffers.numbers, first_node * kWord, buffers.sizes,
                   offsetof(gpu::ClassSizes, first_nodes) + level * kWord, kWord);
        if (level + 1 < candidates.levels().size())
        {
            graph.copy(buffers.first_entries, first_node * kWord, buffers.sizes,
                       offsetof(gpu::ClassSizes, first_entries) + level * kWord, kWord);
        }
    }
}

} // namespace zvo
