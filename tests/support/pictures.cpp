// SPDX-License-Identifier: MIT
#include "support/pictures.h"

namespace zvo::test
{

Picture takePicture(vk::HeadlessDevice& device, const DeviceTree& tree, NodePaths& paths, const TraceCamera& camera,
                    TraceBuffers& buffers, const TraceOptions& options)
{
    device.run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(buffers.hits, gpu::kHitMiss);
            graph.fill(buffers.light, 0);
            buildNodePaths(graph, tree, paths);
            trace(graph, tree, paths, camera, options, buffers);
        });
    const gpu::TraceStatus status = device.download(buffers.status).at(0);
    return {device.download(buffers.image), device.download(buffers.hits), device.download(buffers.light),
            status.live_tiles, status.capped_rays};
}

Picture takePicture(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera, std::uint32_t width,
                    std::uint32_t height, const TraceOptions& options)
{
    NodePaths paths(device.device(), tree.isDag());
    TraceBuffers buffers(device.device(), width, height);
    return takePicture(device, tree, paths, camera, buffers, options);
}

std::uint32_t hitCount(const Picture& picture)
{
    std::uint32_t count = 0;
    for (const gpu::Hit& hit : picture.hits)
    {
        count += hit.index != gpu::kHitMiss ? 1 : 0;
    }
    return count;
}

std::vector<ViewCamera> manyCameras(const Grid& grid)
{
    const auto edge = static_cast<double>(grid.resolution());
    const glm::dvec3 middle(0.5 * edge);
    std::vector<ViewCamera> cameras;
    cameras.push_back(ViewCamera::framing({glm::vec3(0.0F), glm::vec3(static_cast<float>(edge))}, 1.3));
    cameras.push_back(ViewCamera::lookAt(middle, middle + glm::dvec3(1.0, 0.3, 0.2), 1.2));
    cameras.push_back(ViewCamera::lookAt(middle + 0.2, middle + glm::dvec3(0.0, 0.0, 1.0), 2.5));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(0.5, 0.5, 3.0), middle, 0.3));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(1.02, 0.9, 0.4), middle, 1.0));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(20.0, 7.0, -9.0), middle, 0.05));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(20.0, 7.0, -9.0), middle, 1.0));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(300.0, 200.0, 100.0), middle, 0.004));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(5e3, 2e3, 1e3), middle, 0.0003));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(-8e4, 4e4, 5e4), middle, 1e-5));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(0.5, 4.0, 0.5), middle, 0.4));
    cameras.push_back(ViewCamera::lookAt(edge * glm::dvec3(-1.0, 0.5, 0.5), edge * glm::dvec3(-2.0, 0.5, 0.5), 1.0));
    for (const double half_height : {0.02, 0.3, 0.8, 5.0})
    {
        ViewCamera camera = ViewCamera::lookAt(edge * glm::dvec3(1.4, 1.1, 1.7), middle, 0.5);
        camera.orthographic = true;
        camera.half_height = half_height * edge;
        cameras.push_back(camera);
    }
    for (const glm::dvec3& away : {glm::dvec3(2.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, -2.0)}) // along axes, to 0 and -0
    {
        ViewCamera camera = ViewCamera::lookAt(middle + edge * away, middle, 0.5);
        camera.orthographic = true;
        camera.half_height = 0.4 * edge;
        cameras.push_back(camera);
    }
    return cameras;
}

} // namespace zvo::test
