// SPDX-License-Identifier: MIT
// Builds trees from lists of voxels, on the host.
#pragma once

#include "core/tree/tree_data.h"

#include <cstdint>
#include <span>

namespace zvo
{

/// Whether tree has a voxel in this cell. cell may lie outside of the grid, where there are none.
bool hasVoxel(const TreeData& tree, const glm::ivec3& cell);

/// The octree of the voxels with these Morton codes, without attributes. codes: ascending, without duplicates, below
/// 8^grid.depth. Throws Error{Memory} for 2^32 voxels or nodes and more.
TreeData octreeOfVoxels(const Grid& grid, std::span<const std::uint64_t> codes);

/// Gives the voxels of an octree colours, and no normals: pictures take those of their faces. colors: [voxel_count]
/// sRGB red | green << 8 | blue << 16. Nodes get no attributes.
void addColors(TreeData& octree, std::span<const std::uint32_t> colors);

/// Has voxels with colours give off light in addition. emission: [voxel_count] linear radiance, 0 for those that give
/// off none; or empty, where nothing does.
void addEmission(TreeData& octree, std::span<const glm::vec3> emission);

} // namespace zvo
