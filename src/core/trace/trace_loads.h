// SPDX-License-Identifier: MIT
// What rays load of a tree, for measurements.
#pragma once

#include "core/tree/device_tree.h"
#include "trace/trace.h"
#include "vk/frame_graph.h"

namespace zvo
{

/// What a list of rays loads.
struct RayLoads
{
    RayLoads(vk::Device& device, std::uint64_t ray_count);

    vk::BufferOf<gpu::uint> iterations; // [rays]
    /// [kRayLoadsMax][rays]: the 32-byte sector of the tree's nodes and lists that each load is of, in order. Those of
    /// an iteration: of a half node, and in a DAG of an entry, which is the first one where no list is asked.
    vk::BufferOf<gpu::uint> sectors;
};

/// Records the pass that traces rays, which must be valid, as traceRays() does, but in one round, and notes their
/// loads. tree: not empty.
void traceLoads(vk::FrameGraph& graph, const DeviceTree& tree, const vk::BufferOf<gpu::Ray>& rays, RayLoads& loads);

} // namespace zvo
