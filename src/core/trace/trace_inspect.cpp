// SPDX-License-Identifier: MIT
// Reports what the rays of single pixels meet.
#include "core/trace/trace_passes.h"

namespace zvo
{

void inspectPixels(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                   const TraceOptions& options, const TraceBuffers& buffers, const vk::BufferOf<gpu::uint>& pixels,
                   vk::BufferOf<gpu::PixelReport>& reports)
{
    if (isEmpty(tree))
    {
        graph.fill(reports, 0);
        return;
    }
    const AttributeFormat format = showsAttributes(options) ? formatToRead(tree, options) : AttributeFormat::None;
    vk::Pass pass = graph.addPass(
        traversing(gpu::trace::Inspect{.orthographic = camera.orthographic, .format = format}, tree, options));
    gpu::InspectParams params{};
    params.nodes = pass.read(tree.nodes);
    params.leaf_groups = pass.read(tree.leaf_groups);
    params.hits = pass.read(buffers.hits);
    readAttributes(pass, tree, params);
    params.pixels = pass.read(pixels);
    params.reports = pass.write(reports);
    params.camera = camera.rays;
    params.width = buffers.width;
    params.height = buffers.height;
    params.count = static_cast<std::uint32_t>(pixels.count());
    params.detail = detailOf(options, &camera);
    pass.dispatch(pixels.count(), params);
}

} // namespace zvo
