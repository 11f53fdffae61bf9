// SPDX-License-Identifier: MIT
// The steps of SlidesBuilder from sorted fragments to nodes.
#include "baseline/slides_builder.h"

#include "baseline/slides_scan.h"
#include "core/base/divide_up.h"

#include <bit>
#include <cstddef>
#include <numeric>

namespace zvo::baseline
{

void SlidesBuilder::makeUnique(vk::FrameGraph& graph)
{
    vk::Pass pass = graph.addPass(gpu::baseline::SlidesUnique{});
    gpu::SlidesUniqueParams params{};
    params.keys = pass.read(m_sort->keys[m_sorted]);
    params.partials = pass.readWrite(m_unique_partials);
    params.codes = pass.write(m_cells[0].codes);
    params.firsts = pass.write(m_firsts);
    params.key_count = static_cast<std::uint32_t>(m_result.fragment_count);
    params.depth = m_result.tree.grid.depth;
    pass.dispatch(divideUp(m_result.fragment_count, gpu::kSlidesItems), params);
}

void SlidesBuilder::average(vk::FrameGraph& graph)
{
    vk::Pass pass = graph.addPass(gpu::baseline::SlidesAverage{});
    gpu::SlidesAverageParams params{};
    params.scene = readColorTables(pass, m_scene.uploaded());
    params.firsts = pass.read(m_firsts);
    params.indices = pass.read(m_sort->indices[m_sorted]);
    params.fragments = pass.read(m_fragments);
    params.attributes = pass.write(m_result.tree.attributes);
    params.counters = pass.readWrite(m_counters);
    params.voxel_count = m_result.tree.voxel_count;
    params.fragment_count = static_cast<std::uint32_t>(m_result.fragment_count);
    pass.dispatch(m_result.tree.voxel_count, params);
}

// Finds the class of each candidate, and makes the classes nodes of the tree.
void SlidesBuilder::mergeLevel(vk::FrameGraph& graph, std::uint32_t level, Cells& parents)
{
    const std::uint32_t count = m_cell_counts[level + 1];
    const auto words = static_cast<std::uint32_t>(m_options.nodes);
    const std::uint64_t slot_count = std::bit_ceil(2 * std::uint64_t{count});
    const std::uint64_t block_threads = divideUp(count, gpu::kSlidesItems);
    graph.fill(m_classes.table, gpu::kSlidesFreeSlot, 0, slot_count);
    gpu::SlidesClassParams common{};
    common.candidate_count = count;
    common.slot_mask = static_cast<std::uint32_t>(slot_count - 1);
    common.level = level;
    {
        vk::Pass pass = graph.addPass(gpu::baseline::SlidesClassInsert{.node_words = words});
        gpu::SlidesClassParams params = common;
        params.candidates = pass.read(m_classes.candidates);
        params.table = pass.readWrite(m_classes.table);
        params.slots = pass.write(m_classes.slots);
        params.counters = pass.readWrite(m_counters);
        pass.dispatch(count, params);
    }
    {
        vk::Pass pass = graph.addPass(gpu::baseline::SlidesClassCount{});
        gpu::SlidesClassParams params = common;
        params.table = pass.readWrite(m_classes.table);
        params.slots = pass.readWrite(m_classes.slots);
        params.partials = pass.write(m_partials);
        pass.dispatch(block_threads, params);
    }
    scanPartials(graph, m_partials, partialCount(count),
                 totalAt(m_counters, offsetof(gpu::SlidesCounters, node_counts) + level * sizeof(gpu::uint)));
    {
        vk::Pass pass = graph.addPass(gpu::baseline::SlidesClassNodes{.node_words = words});
        gpu::SlidesClassParams params = common;
        params.candidates = pass.read(m_classes.candidates);
        params.table = pass.readWrite(m_classes.table);
        params.slots = pass.readWrite(m_classes.slots);
        params.partials = pass.readWrite(m_partials);
        params.numbers = pass.write(m_classes.numbers);
        params.nodes = pass.readWrite(m_result.tree.nodes);
        params.counters = pass.readWrite(m_counters);
        pass.dispatch(block_threads, params);
    }
    vk::Pass pass = graph.addPass(gpu::baseline::SlidesClassChildren{});
    gpu::SlidesClassParams params = common;
    params.table = pass.readWrite(m_classes.table);
    params.slots = pass.readWrite(m_classes.slots);
    params.numbers = pass.readWrite(m_classes.numbers);
    params.parent_nodes = pass.write(parents.nodes);
    pass.dispatch(count, params);
}

// Makes the parents of the cells of a level, voxels being level 0.
void SlidesBuilder::makeLevel(vk::FrameGraph& graph, std::uint32_t level)
{
    const Cells& cells = m_cells[level % 2];
    Cells& parents = m_cells[(level + 1) % 2];
    const std::uint32_t count = m_cell_counts[level];
    const std::uint64_t threads = divideUp(count, gpu::kSlidesItems);
    const auto words = static_cast<std::uint32_t>(m_options.nodes);
    const std::uint32_t first_node = std::accumulate(m_cell_counts.begin() + 1, m_cell_counts.begin() + 1 + level, 0U);
    {
        vk::Pass pass = graph.addPass(gpu::baseline::SlidesParentsCount{});
        gpu::SlidesParentsParams params{};
        params.codes = pass.read(cells.codes);
        params.partials = pass.write(m_partials);
        params.cell_count = count;
        pass.dispatch(threads, params);
    }
    // Of a DAG, mergeLevel() writes the number of different nodes in place of this one.
    scanPartials(graph, m_partials, partialCount(count),
                 totalAt(m_counters, offsetof(gpu::SlidesCounters, node_counts) + level * sizeof(gpu::uint)));
    {
        vk::Pass pass = graph.addPass(
            gpu::baseline::SlidesParents{.node_words = words, .leaves = level == 0, .dag = m_options.dag});
        gpu::SlidesParentsParams params{};
        params.codes = pass.read(cells.codes);
        params.children = pass.read(cells.nodes);
        params.voxels = pass.read(cells.voxels);
        params.partials = pass.readWrite(m_partials);
        params.parent_codes = pass.write(parents.codes);
        params.parent_nodes = pass.write(parents.nodes);
        params.parent_voxels = pass.write(parents.voxels);
        params.nodes = m_options.dag ? pass.write(m_classes.candidates) : pass.readWrite(m_result.tree.nodes);
        params.nodes.address += m_options.dag ? 0 : std::uint64_t{first_node} * words * sizeof(gpu::uint);
        params.cell_count = count;
        params.first_node = first_node;
        pass.dispatch(threads, params);
    }
    if (m_options.dag)
    {
        mergeLevel(graph, level, parents);
    }
}

void SlidesBuilder::makeNodes(vk::FrameGraph& graph)
{
    makeUnique(graph);
    if (m_options.attributes)
    {
        average(graph);
    }
    for (std::uint32_t level = 0; level < m_result.tree.grid.depth; ++level)
    {
        makeLevel(graph, level);
    }
    readCounters(graph);
}

} // namespace zvo::baseline
