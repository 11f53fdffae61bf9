// SPDX-License-Identifier: MIT
// Reports what one pixel's ray meets.
#include "core/trace/trace_passes.h"

namespace zvo
{

void inspectPixel(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
                  const TraceBuffers& buffers, glm::uvec2 pixel, vk::BufferOf<gpu::PixelReport>& report)
{
    if (isEmpty(tree))
    {
        graph.fill(report, 0);
        return;
    }
    const AttributeFormat format = showsAttributes(options) ? formatToRead(tree, options) : AttributeFormat::None;
    vk::Pass pass = graph.addPass(
        traversing(gpu::trace::Inspect{.orthographic = camera.orthographic, .format = format}, tree, options));
    gpu::InspectParams params{};
    params.nodes = pass.read(tree.nodes);
    params.hits = pass.read(buffers.hits);
    readAttributes(pass, tree, params);
    params.report = pass.write(report);
    params.camera = camera.rays;
    params.width = buffers.width;
    params.height = buffers.height;
    params.pixel = pixel.y * buffers.width + pixel.x;
    params.detail = detailOf(options, &camera);
    pass.dispatch(1, params);
}

} // namespace zvo
