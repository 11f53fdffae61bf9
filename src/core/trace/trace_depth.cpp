// SPDX-License-Identifier: MIT
#include "core/trace/trace_depth.h"

#include "core/trace/trace_passes.h"
#include "zvo/error.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace zvo
{

namespace
{

// A row of the host's matrix along the rays of a camera, as DepthParams has it.
gpu::vec4 alongRays(const glm::dvec4& row, const Grid& grid, const gpu::CameraRays& rays)
{
    const double edge = static_cast<double>(grid.voxel_size) * grid.rootResolution();
    const glm::dvec3 gain = edge * glm::dvec3(row); // per unit of unit space
    const glm::dvec3 origin = glm::dvec3(grid.origin) + edge * (glm::dvec3(rays.origin) - 1.0);
    return gpu::vec4(glm::dvec4(glm::dot(glm::dvec3(row), origin) + row.w, glm::dot(gain, glm::dvec3(rays.forward)),
                                glm::dot(gain, glm::dvec3(rays.half_pixel_x)),
                                glm::dot(gain, glm::dvec3(rays.half_pixel_y))));
}

bool isFinite(const gpu::vec4& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

} // namespace

ClipDepth ClipDepth::of(const glm::dmat4& view_projection, float miss)
{
    const glm::dmat4 rows = glm::transpose(view_projection);
    return {rows[2], rows[3], miss};
}

void traceDepth(vk::FrameGraph& graph, const Grid& grid, const TraceCamera& camera, const ClipDepth& clip,
                const TraceBuffers& buffers, vk::BufferOf<float>& depth)
{
    const std::uint64_t pixel_count = std::uint64_t{buffers.width} * buffers.height;
    if (depth.count() < pixel_count)
    {
        throw Error(ErrorCode::Usage, fmt::format("depth of a picture of {} x {} pixels does not fit into buffer {} of "
                                                  "{} floats: give it one for each pixel",
                                                  buffers.width, buffers.height, depth.name(), depth.count()));
    }
    gpu::DepthParams params{};
    params.clip_z = alongRays(clip.z, grid, camera.rays);
    params.clip_w = alongRays(clip.w, grid, camera.rays);
    if (!isFinite(params.clip_z) || !isFinite(params.clip_w) || !(clip.miss >= 0.0F && clip.miss <= 1.0F))
    {
        throw Error(ErrorCode::Usage, "the transform for depth must have finite rows z and w of a matrix from world to "
                                      "clip space, and a depth in [0, 1] for rays that hit nothing");
    }
    graph.fill(depth, std::bit_cast<std::uint32_t>(clip.miss), 0, pixel_count);
    vk::Pass pass = graph.addPass(gpu::trace::Depth{.orthographic = camera.orthographic});
    params.live = pass.read(buffers.live);
    params.hits = pass.read(buffers.hits);
    params.depth = pass.readWrite(depth);
    params.width = buffers.width;
    params.height = buffers.height;
    pass.dispatchIndirect(buffers.args, 0, params, buffers.live.count());
}

} // namespace zvo
