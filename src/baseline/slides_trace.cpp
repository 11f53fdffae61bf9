// SPDX-License-Identifier: MIT
#include "baseline/slides_trace.h"

#include "core/base/divide_up.h"

namespace zvo::baseline
{

SlidesTraceBuffers::SlidesTraceBuffers(vk::Device& device, std::uint32_t picture_width, std::uint32_t picture_height)
    : width(picture_width), height(picture_height),
      hits(device, "slides/hits", std::uint64_t{picture_width} * picture_height), status(device, "slides/status", 1)
{
}

void slidesTrace(vk::FrameGraph& graph, const SlidesTree& tree, const TraceCamera& camera,
                 const SlidesTraceOptions& options, SlidesTraceBuffers& buffers)
{
    graph.fill(buffers.status, 0);
    if (tree.node_count == 0)
    {
        graph.fill(buffers.hits, gpu::kHitMiss);
        return;
    }
    vk::Pass pass = graph.addPass(gpu::baseline::SlidesTrace{.node_words = static_cast<std::uint32_t>(tree.node_words),
                                                             .push_children = options.push_children,
                                                             .stop_at_far_side = options.stop_at_far_side,
                                                             .skip_behind = options.skip_behind,
                                                             .orthographic = camera.orthographic});
    gpu::SlidesTraceParams params{};
    params.nodes = pass.read(tree.nodes);
    params.hits = pass.write(buffers.hits);
    params.status = pass.readWrite(buffers.status);
    params.camera = camera.rays;
    params.width = buffers.width;
    params.height = buffers.height;
    params.root = tree.root();
    params.depth = tree.grid.depth;
    const std::uint64_t tiles = divideUp(buffers.width, gpu::kTileEdge) * divideUp(buffers.height, gpu::kTileEdge);
    pass.dispatch(tiles * gpu::kTilePixels, params);
}

} // namespace zvo::baseline
