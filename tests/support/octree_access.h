// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree.h"
#include "oracle/octree_check.h"
#include "vk/headless.h"

#include <vector>

namespace zvo::test
{

/// The levels of octree as the oracles take them.
inline std::vector<oracle::NodeRange> levelsOf(const Octree& octree)
{
    std::vector<oracle::NodeRange> levels;
    for (const Octree::Level& level : octree.levels)
    {
        levels.push_back({level.first_node, level.node_count});
    }
    return levels;
}

/// Voxels of octree and what is wrong with its nodes.
inline oracle::OctreeContents contentsOf(vk::HeadlessDevice& device, const Octree& octree)
{
    return oracle::checkOctree(device.download(octree.nodes), levelsOf(octree), octree.grid.depth);
}

} // namespace zvo::test
