// SPDX-License-Identifier: MIT
// Pictures of octrees, and cameras to take them with.
#pragma once

#include "core/trace/trace.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo::test
{

/// A picture with its hits and counts.
struct Picture
{
    std::vector<gpu::uint> image;
    std::vector<gpu::Hit> hits;   // in dead tiles: misses
    std::vector<gpu::uint> light; // 0 in dead tiles
    std::uint32_t live_tiles = 0;
    std::uint32_t capped_rays = 0;
};

Picture takePicture(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera, std::uint32_t width,
                    std::uint32_t height, const TraceOptions& options);

/// Takes the picture with node paths that were used before.
Picture takePicture(vk::HeadlessDevice& device, const DeviceTree& tree, NodePaths& paths, const TraceCamera& camera,
                    TraceBuffers& buffers, const TraceOptions& options);

std::uint32_t hitCount(const Picture& picture);

/// Cameras inside, outside, close, far away, along axes, and orthographic ones, for a grid with its corner at 0.
std::vector<ViewCamera> manyCameras(const Grid& grid);

} // namespace zvo::test
