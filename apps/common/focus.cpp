// SPDX-License-Identifier: MIT
#include "common/focus.h"

#include "core/trace/trace.h"

#include <array>
#include <cmath>
#include <span>

namespace zvo::cli
{

namespace
{

// As inverseDirection() of shaders/lib/ray.glsl.
float inverseOf(float component)
{
    constexpr float kSmallest = 1e-20F;
    return 1.0F / (std::abs(component) < kSmallest ? std::copysign(kSmallest, component) : component);
}

} // namespace

std::optional<float> distanceAtMiddle(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera)
{
    const glm::vec3& forward = camera.rays.forward; // of length 1, so times along the ray are distances
    const std::array<gpu::Ray, 1> ray = {{{camera.rays.origin,
                                           gpu::kTraceTimeMin,
                                           {inverseOf(forward.x), inverseOf(forward.y), inverseOf(forward.z)},
                                           gpu::kTraceTimeMax}}};
    const vk::BufferOf<gpu::Ray> rays = device.makeBuffer("focus/ray", std::span<const gpu::Ray>(ray));
    vk::BufferOf<gpu::Hit> hits(device.device(), "focus/hit", 1);
    vk::BufferOf<gpu::DispatchArgs> rounds(device.device(), "focus/rounds", gpu::kTraceRoundsMax);
    vk::BufferOf<gpu::TraceStatus> status(device.device(), "focus/status", 1);
    device.run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(status, 0);
            traceRays(graph, tree, rays, hits, rounds, status, {});
        });
    const gpu::Hit hit = device.download(hits).front();
    if (hit.index == gpu::kHitMiss || !(hit.t > gpu::kTraceTimeMin))
    {
        return std::nullopt;
    }
    return hit.t * tree.grid.voxel_size * static_cast<float>(tree.grid.rootResolution());
}

} // namespace zvo::cli
