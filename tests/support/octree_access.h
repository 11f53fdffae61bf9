// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/leaf_words.h"
#include "oracle/octree_check.h"
#include "shared/octree.h"
#include "vk/headless.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace zvo::test
{

/// The levels of octree in the oracles' type.
inline std::vector<oracle::NodeRange> levelsOf(const DeviceTree& octree)
{
    std::vector<oracle::NodeRange> levels;
    for (const DeviceTree::Level& level : octree.levels)
    {
        levels.push_back({level.first_node, level.node_count});
    }
    return levels;
}

/// The nodes of an octree with levels, its leaves among them.
inline std::vector<gpu::Node> octreeNodes(vk::HeadlessDevice& device, const DeviceTree& octree)
{
    TreeData data;
    data.levels = octree.levels;
    setNodes(device.download(octree.nodes), octree, data);
    return data.nodes;
}

/// The voxels of octree, and the faults in its nodes.
inline oracle::OctreeContents contentsOf(vk::HeadlessDevice& device, const DeviceTree& octree)
{
    return oracle::checkOctree(octreeNodes(device, octree), levelsOf(octree), octree.grid.depth);
}

/// Unpacks an octahedral normal in floating point (Cigolle et al. 2014); 0 where there is none.
inline glm::dvec3 normalOf(const gpu::Attribute& attribute)
{
    if (attribute.normal == gpu::kNoNormal)
    {
        return glm::dvec3(0.0);
    }
    const double x = static_cast<std::int16_t>(attribute.normal & 0xFFFF) / 32767.0;
    const double y = static_cast<std::int16_t>(attribute.normal >> 16) / 32767.0;
    glm::dvec3 n(x, y, 1 - std::abs(x) - std::abs(y));
    if (n.z < 0)
    {
        n = {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1), n.z};
    }
    return glm::normalize(n);
}

} // namespace zvo::test
