// SPDX-License-Identifier: MIT
#include "core/trace/trace_loads.h"

#include "core/trace/trace_passes.h"

namespace zvo
{

RayLoads::RayLoads(vk::Device& device, std::uint64_t ray_count)
    : iterations(device, "ray iterations", ray_count), sectors(device, "ray sectors", ray_count * gpu::kRayLoadsMax)
{
}

void traceLoads(vk::FrameGraph& graph, const DeviceTree& tree, const vk::BufferOf<gpu::Ray>& rays, RayLoads& loads)
{
    vk::Pass pass = graph.addPass(traversing(gpu::trace::RayLoads{}, tree, {}));
    const gpu::RayLoadsParams params{.nodes = pass.read(tree.nodes),
                                     .rays = pass.read(rays),
                                     .iterations = pass.write(loads.iterations),
                                     .sectors = pass.write(loads.sectors),
                                     .ray_count = static_cast<std::uint32_t>(rays.count())};
    pass.dispatch(rays.count(), params);
}

} // namespace zvo
