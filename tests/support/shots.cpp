// SPDX-License-Identifier: MIT
#include "support/shots.h"

namespace zvo::test
{

namespace
{

constexpr std::uint32_t kWidth = 40;
constexpr std::uint32_t kHeight = 24;
constexpr std::array kViews = {View::Color, View::Albedo, View::Normal};
constexpr double kFieldOfView = 0.9;
constexpr std::uint32_t kCoarseLevel = 1;

} // namespace

TraceCamera Shot::camera(const Grid& grid, float extent) const
{
    const glm::dvec3 from = (glm::dvec3(eye[0], eye[1], eye[2]) * 2.0 + 1.0) * (extent / 8.0);
    const glm::dvec3 to = glm::dvec3(target[0], target[1], target[2]) * (extent / 4.0);
    ViewCamera view = ViewCamera::lookAt(from, to, kFieldOfView);
    view.orthographic = orthographic;
    view.half_height = 0.5 * extent;
    return traceCamera(view, grid, kHeight);
}

std::ostream& operator<<(std::ostream& out, const Shot& shot)
{
    return out << "shot from " << shot.eye[0] << " " << shot.eye[1] << " " << shot.eye[2] << " at " << shot.target[0]
               << " " << shot.target[1] << " " << shot.target[2] << ", orthographic " << shot.orthographic << ", beam "
               << shot.beam << ", lit " << shot.lit << ", coarse " << shot.coarse;
}

ShotTaker::ShotTaker(vk::Device& device)
    : m_buffers(device, kWidth, kHeight),
      m_pictures(device, "pictures", kViews.size() * kWidth * kHeight, vk::MemoryKind::Readback)
{
}

void ShotTaker::record(vk::FrameGraph& graph, const DeviceTree& tree, NodePaths& paths, const TraceCamera& camera,
                       const Shot& shot)
{
    TraceOptions options;
    options.beam = shot.beam;
    options.shadows = shot.lit;
    options.occlusion_rays = shot.lit ? 2 : 0;
    options.detail_level = shot.coarse ? kCoarseLevel : UINT32_MAX;
    if (shot.beam)
    {
        buildNodePaths(graph, tree, paths);
    }
    tracePrimary(graph, tree, paths, camera, options, m_buffers);
    traceLight(graph, tree, paths, camera, options, m_buffers);
    for (std::size_t i = 0; i < kViews.size(); ++i)
    {
        options.view = kViews[i];
        shade(graph, tree, camera, options, m_buffers, {m_buffers.image, m_buffers.texels});
        graph.copy(m_buffers.image, 0, m_pictures, i * m_buffers.image.bytes(), m_buffers.image.bytes());
    }
}

std::vector<gpu::uint> ShotTaker::pictures() const
{
    return {m_pictures.mappedData(), m_pictures.mappedData() + m_pictures.count()};
}

} // namespace zvo::test
