// SPDX-License-Identifier: MIT
// What must hold of every tree that checkTree accepts, wherever its bytes are from.
#pragma once

#include "core/trace/trace.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

#include <random>
#include <string>

namespace zvo::test
{

/// Walks through tree on the host. "" or what is wrong: voxels come in ascending order, inside of the grid, as many as
/// are counted; no more nodes differ than there are.
std::string walkFault(const TreeData& tree);

/// Traces many trees on one device, with the same buffers.
class TreeProbe
{
public:
    explicit TreeProbe(vk::HeadlessDevice& device);

    /// Copies tree to the device and traces a picture and rays with options that random chooses. "" or what is wrong: a
    /// ray that reaches its cap, a hit whose number is none of the voxels'.
    std::string traceFault(const TreeData& tree, std::mt19937& random);

private:
    vk::HeadlessDevice& m_device;
    BeamGrid m_octree_beam;
    BeamGrid m_dag_beam;
    TraceBuffers m_picture;
    vk::BufferOf<gpu::Ray> m_rays;
    vk::BufferOf<gpu::Hit> m_hits; // [m_rays.count()], like those of the picture
    vk::BufferOf<gpu::DispatchArgs> m_rounds;
    vk::BufferOf<gpu::TraceStatus> m_status;
};

} // namespace zvo::test
