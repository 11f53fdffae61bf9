// SPDX-License-Identifier: MIT
#include "core/trace/trace_beam.h"

#include "core/trace/trace_passes.h"
#include "core/trace/trace_ranks.h"
#include "trace/beam.h"
#include "vk/device.h"

#include <algorithm>
#include <numeric>

namespace zvo
{

namespace
{

constexpr std::uint64_t kPathCellCount = std::uint64_t{gpu::kPathCells} * gpu::kPathCells * gpu::kPathCells;

// Whether the tree has cells as small as the beam grid's finer ones.
bool hasFineBeam(const DeviceTree& tree)
{
    return tree.grid.nodeLevels() > gpu::kBeamLevels;
}

// Whether the children of all nodes that paths (shaders/trace/beam.h) name are nodes, not voxels.
bool hasPaths(const DeviceTree& tree)
{
    return tree.grid.nodeLevels() > gpu::kPathLevels;
}

// Blocks that a workgroup refines, one after the other. Most have no cells. On software devices workgroups without any
// work cost as much as others.
std::uint32_t blocksOn(const vk::Device& device)
{
    return device.report().type == "cpu" ? gpu::kBeamBlocksMax : 1;
}

// A number near the golden section of count that shares no factor with it.
std::uint32_t coprimeStride(std::uint32_t count)
{
    auto stride = static_cast<std::uint32_t>(0.618 * count) | 1U;
    while (std::gcd(stride, count) != 1)
    {
        ++stride;
    }
    return stride;
}

} // namespace

BeamGrid::BeamGrid(vk::Device& device, bool for_dag)
    : masks(device, "beam masks", gpu::kBeamMasks), nodes(device, "beam nodes", gpu::kBeamNodes),
      paths(device, "paths", for_dag ? std::uint64_t{gpu::kRankTableOverlays} + 1 : kPathCellCount)
{
}

bool standsByLevels(const DeviceTree& tree)
{
    if (tree.levels.empty())
    {
        return false;
    }
    const DeviceTree::Level& last = tree.levels.back();
    const std::uint64_t node_count = tree.isDag() ? tree.node_count : tree.nodes.count();
    return std::uint64_t{last.first_node} + last.node_count == node_count;
}

bool usesPaths(const DeviceTree& tree, const TraceOptions& options)
{
    return options.beam && hasPaths(tree) && !isEmpty(tree) && !options.hasDetail();
}

void buildBeam(vk::FrameGraph& graph, const DeviceTree& tree, BeamGrid& beam)
{
    if (isEmpty(tree))
    {
        return;
    }
    const std::uint32_t per_word = tree.entriesPerWord();
    const std::uint32_t levels = std::min(tree.grid.nodeLevels(), gpu::kBeamLevels);
    {
        vk::Pass pass = graph.addPass(gpu::trace::BeamNodes{.entries_per_word = per_word, .levels = levels});
        const gpu::BeamNodesParams params = {pass.read(tree.nodes), pass.write(beam.masks), pass.readWrite(beam.nodes)};
        pass.dispatch(gpu::kBeamGroup * gpu::kBeamGroup, params);
    }
    {
        const std::uint32_t blocks = blocksOn(graph.device());
        vk::Pass pass = graph.addPass(gpu::trace::BeamRefine{.entries_per_word = per_word, .blocks = blocks});
        const gpu::BeamRefineParams params = {pass.read(tree.nodes), pass.read(beam.masks), pass.readWrite(beam.nodes)};
        pass.dispatch(gpu::kBeamGroup * (1 + (hasFineBeam(tree) ? gpu::kBeamBlocks / blocks : 0)), params);
    }
    if (hasPaths(tree))
    {
        vk::Pass pass = graph.addPass(gpu::trace::BeamPaths{.entries_per_word = per_word});
        const gpu::BeamPathsParams params = {pass.read(tree.nodes), pass.write(beam.paths)};
        pass.dispatch(kPathCellCount, params);
    }
    if (tree.isDag() && tree.hasAttributes())
    {
        buildRankTable(graph, tree, beam);
    }
}

void traceBeam(vk::FrameGraph& graph, const DeviceTree& tree, const BeamGrid& beam, const TraceCamera& camera,
               const TraceOptions& options, TraceBuffers& buffers)
{
    graph.fill(buffers.live, gpu::kNoTile);
    graph.fill(buffers.args, 0);
    graph.fill(buffers.status, 0);
    const PictureTiles tiles(buffers);
    const bool fine = hasFineBeam(tree);
    vk::Pass pass = graph.addPass(gpu::trace::Beam{.node_levels = fine ? gpu::kBeamLevels + 1 : gpu::kBeamLevels,
                                                   .stack = stackConstant(graph.device(), options),
                                                   .detail = fine,
                                                   .orthographic = camera.orthographic,
                                                   .beam = options.beam,
                                                   .empty = isEmpty(tree)});
    gpu::BeamParams params{};
    params.nodes = pass.read(beam.nodes);
    params.starts = pass.write(buffers.starts);
    params.live = pass.write(buffers.live);
    params.args = pass.readWrite(buffers.args);
    params.status = pass.readWrite(buffers.status);
    params.camera = camera.rays;
    params.width = buffers.width;
    params.height = buffers.height;
    params.block_stride = coprimeStride(static_cast<std::uint32_t>(tiles.blocks));
    params.detail = detailOf(options, &camera);
    pass.dispatch(tiles.blocks * gpu::kBlockTiles, params);
}

} // namespace zvo
