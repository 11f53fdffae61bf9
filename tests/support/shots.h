// SPDX-License-Identifier: MIT
// Small pictures of octrees that are taken repeatedly, also in frames in flight.
#pragma once

#include "core/trace/trace.h"
#include "vk/headless.h"

#include <array>
#include <cstdint>
#include <ostream>
#include <vector>

namespace zvo::test
{

/// Camera and options of a picture.
struct Shot
{
    /// The camera stands at 2 eye + 1 eighths of the extent: in any direction, near, far or inside.
    std::array<int, 3> eye = {10, 5, 12};
    std::array<int, 3> target = {2, 2, 2}; // quarters of the extent, never equal to the eye
    bool orthographic = false;
    bool beam = true;
    bool lit = true;     // with shadows and occlusion
    bool coarse = false; // nodes of level 1 and their averages instead of voxels

    /// The camera for a scene with the extent [0, extent]^3 in a grid.
    [[nodiscard]] TraceCamera camera(const Grid& grid, float extent) const;
};

std::ostream& operator<<(std::ostream& out, const Shot& shot);

/// Takes pictures of octrees with the same shot, in all views that shade the same hits.
class ShotTaker
{
public:
    explicit ShotTaker(vk::Device& device);

    /// Records the passes for pictures of tree, which overwrite the last ones. paths are made anew.
    void record(vk::FrameGraph& graph, const DeviceTree& tree, NodePaths& paths, const TraceCamera& camera,
                const Shot& shot);

    /// The pixels of all views. The device must be done with what was recorded, including FrameGraph::releaseToHost().
    [[nodiscard]] std::vector<gpu::uint> pictures() const;

private:
    TraceBuffers m_buffers;
    vk::BufferOf<gpu::uint> m_pictures;
};

} // namespace zvo::test
