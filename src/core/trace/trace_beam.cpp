// SPDX-License-Identifier: MIT
#include "core/trace/trace_beam.h"

#include "core/base/lanes.h"
#include "core/trace/trace_passes.h"
#include "trace/beam.h"

#include <algorithm>
#include <numeric>

namespace zvo
{

namespace
{

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

void traceBeam(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
               TraceBuffers& buffers)
{
    graph.fill(buffers.live, gpu::kNoTile);
    graph.fill(buffers.args, 0);
    graph.fill(buffers.status, 0);
    const PictureTiles tiles(buffers);
    const std::uint32_t lanes = beamLanesOn(graph.device());
    const std::uint32_t iterations_max = std::min(options.iterations_max, gpu::kBeamIterationsMax);
    vk::Pass pass = graph.addPass(gpu::trace::Beam{.node_levels = tree.grid.nodeLevels(),
                                                   .entries_per_word = tree.entriesPerWord(),
                                                   .iterations_max = iterations_max,
                                                   .orthographic = camera.orthographic,
                                                   .beam = options.beam,
                                                   .empty = isEmpty(tree),
                                                   .lanes = lanes});
    pass.dispatch(tiles.blocks * gpu::kBlockTiles * lanes,
                  {.nodes = pass.read(tree.nodes),
                   .starts = pass.write(buffers.starts),
                   .live = pass.write(buffers.live),
                   .args = pass.readWrite(buffers.args),
                   .status = pass.readWrite(buffers.status),
                   .camera = camera.rays,
                   .width = buffers.width,
                   .height = buffers.height,
                   .block_stride = coprimeStride(static_cast<std::uint32_t>(tiles.blocks)),
                   .detail = detailOf(options, &camera)});
}

} // namespace zvo
