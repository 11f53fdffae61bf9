// SPDX-License-Identifier: MIT
// Trees from lists of voxels, on the host.
#pragma once

#include "core/tree/tree_data.h"

#include <cstdint>
#include <span>

namespace zvo
{

/// Whether tree has the voxel; cell: any coordinates, those outside of the grid have none.
bool hasVoxel(const TreeData& tree, const glm::ivec3& cell);

/// The octree of codes, ascending and each once, below 8^grid.depth; without attributes. Throws Error{Memory} for 2^32
/// voxels or nodes and more.
TreeData octreeOfVoxels(const Grid& grid, std::span<const std::uint64_t> codes);

/// Gives the voxels of an octree colours and normals: those point from where there are most of the 26 neighbours to
/// where there are fewest. colors: [voxel_count] sRGB red | green << 8 | blue << 16. Nodes get no attributes.
void addColors(TreeData& octree, std::span<const std::uint32_t> colors);

/// Octahedral code of v's direction, as shaders/lib/attribute.glsl makes it; components below 2^15.
std::uint32_t octahedralCode(const glm::ivec3& v);

} // namespace zvo
