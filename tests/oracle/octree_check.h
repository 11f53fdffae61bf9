// SPDX-License-Identifier: MIT
#pragma once

#include "shared/octree.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo::oracle
{

/// The nodes of a level; level 0 is the root's.
struct NodeRange
{
    std::uint32_t first_node = 0;
    std::uint32_t node_count = 0;
};

struct OctreeContents
{
    std::vector<std::uint64_t> codes; // Morton codes of the voxels, in the order of their attribute indices
    std::vector<std::string>
        violations; // empty: the octree is valid by shaders/shared/octree.h. At most kViolationsMax
};

constexpr std::size_t kViolationsMax = 20;

/// Expands downloaded nodes to voxels and checks that the bytes are the only ones for this set of voxels: levels are
/// contiguous, and as many as depth (of the grid) needs; no node is empty; every base equals the running count; voxels
/// come in Morton order and lie inside of the grid. An octree without voxels has neither nodes nor levels.
OctreeContents checkOctree(std::span<const gpu::Node> nodes, std::span<const NodeRange> levels, std::uint32_t depth);

/// The octree of sorted, unique Morton codes, made directly. checkOctree() accepts it.
struct ReferenceOctree
{
    std::vector<gpu::Node> nodes;
    std::vector<NodeRange> levels;
};
ReferenceOctree referenceOctree(std::span<const std::uint64_t> codes, std::uint32_t depth);

} // namespace zvo::oracle
