// SPDX-License-Identifier: MIT
#pragma once

#include "shared/octree.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo::oracle
{

/// Where one level's nodes stand; level 0 is the root.
struct NodeRange
{
    std::uint32_t first_node = 0;
    std::uint32_t node_count = 0;
};

struct OctreeContents
{
    std::vector<std::uint64_t> codes;    // Morton codes of the voxels, in the order of their attribute indices
    std::vector<std::string> violations; // empty: the octree is as shaders/shared/octree.h says. At most kViolationsMax
};

constexpr std::size_t kViolationsMax = 20;

/// Expands downloaded nodes to voxels and checks everything that makes the bytes unique for a set of voxels: levels
/// contiguous and as many as depth (of the grid) asks for, no empty node, every base equal to the running count, voxels
/// in Morton order and inside of the grid. An octree without voxels has neither nodes nor levels.
OctreeContents checkOctree(std::span<const gpu::Node> nodes, std::span<const NodeRange> levels, std::uint32_t depth);

/// The octree of sorted, unique Morton codes: what checkOctree() accepts, made the direct way.
struct ReferenceOctree
{
    std::vector<gpu::Node> nodes;
    std::vector<NodeRange> levels;
};
ReferenceOctree referenceOctree(std::span<const std::uint64_t> codes, std::uint32_t depth);

} // namespace zvo::oracle
