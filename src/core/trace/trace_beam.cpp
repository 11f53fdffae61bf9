// SPDX-License-Identifier: MIT
#include "core/trace/trace_beam.h"

#include "core/trace/trace_passes.h"
#include "core/trace/trace_ranks.h"
#include "trace/beam.h"

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
    : occupied(device, "beam occupied", gpu::kBeamRows), rows(device, "beam rows", gpu::kBeamRows),
      masks(device, "beam masks", gpu::kBeamMasks), nodes(device, "beam nodes", gpu::kBeamNodes),
      paths(device, "paths", for_dag ? std::uint64_t{gpu::kRankTableOverlays} + 1 : kPathCellCount)
{
}

bool hasPaths(const DeviceTree& tree)
{
    return tree.grid.nodeLevels() > gpu::kPathLevels;
}

void buildBeam(vk::FrameGraph& graph, const DeviceTree& tree, BeamGrid& beam)
{
    if (isEmpty(tree))
    {
        return;
    }
    const std::uint32_t levels = std::min(tree.grid.nodeLevels(), gpu::kBeamLevels);
    const std::uint32_t cells = 1U << (2 * levels);
    const std::uint32_t per_word = tree.entriesPerWord();
    {
        vk::Pass pass = graph.addPass(gpu::trace::BeamMark{.entries_per_word = per_word});
        const gpu::BeamMarkParams params = {pass.read(tree.nodes), pass.write(beam.occupied), levels, cells};
        pass.dispatch(cells * cells, params);
    }
    {
        vk::Pass pass = graph.addPass(gpu::trace::BeamDilate{});
        const gpu::BeamDilateParams params = {pass.read(beam.occupied), pass.write(beam.rows), cells};
        pass.dispatch(gpu::kBeamRows, params);
    }
    for (const bool level2 : {true, false})
    {
        vk::Pass pass = graph.addPass(gpu::trace::BeamNodes{.level2 = level2});
        const gpu::BeamNodesParams params = {pass.read(beam.rows), pass.readWrite(beam.masks),
                                             pass.readWrite(beam.nodes)};
        pass.dispatch(gpu::kBeamGroup * (level2 ? gpu::kBeamGroup : 1), params);
    }
    if (hasFineBeam(tree))
    {
        vk::Pass pass = graph.addPass(gpu::trace::BeamRefine{.entries_per_word = per_word});
        const gpu::BeamRefineParams params = {pass.read(tree.nodes), pass.read(beam.masks), pass.readWrite(beam.nodes)};
        pass.dispatch(gpu::kBeamRows * gpu::kBeamGroup, params);
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
