// SPDX-License-Identifier: MIT
// Properties of every tree that checkTree accepts, whatever its bytes.
#pragma once

#include "core/trace/trace.h"
#include "core/tree/tree_data.h"
#include "vk/headless.h"

#include <random>
#include <string>

namespace zvo::test
{

/// Walks through tree on the host. Returns "", or what is wrong: voxels must come in ascending order, inside of the
/// grid, and as many as are counted; there must be at least as many nodes as differ.
std::string walkFault(const TreeData& tree);

/// Traces many trees on one device, with the same buffers.
class TreeProbe
{
public:
    explicit TreeProbe(vk::HeadlessDevice& device);

    /// Copies tree to the device, and traces a picture and rays with random options. Returns "", or what is wrong: a
    /// ray reached its cap, or a hit has an index that no voxel has.
    std::string traceFault(const TreeData& tree, std::mt19937& random);

private:
    vk::HeadlessDevice& m_device;
    NodePaths m_octree_paths;
    NodePaths m_dag_paths;
    TraceBuffers m_picture;
    vk::BufferOf<gpu::Ray> m_rays;
    vk::BufferOf<gpu::Hit> m_hits; // [m_rays.count()]
    vk::BufferOf<gpu::DispatchArgs> m_rounds;
    vk::BufferOf<gpu::TraceStatus> m_status;
};

} // namespace zvo::test
