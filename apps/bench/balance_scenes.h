// SPDX-License-Identifier: MIT
// Scenes that try the balance of load, made for a grid with its corner at the origin and voxels of size 1.
#pragma once

#include "core/scene/scene.h"

#include <cstdint>

namespace zvo::cli
{

/// One triangle, tilted, over about (resolution / 2)^2 columns: 1024^2 at a resolution of 2048.
Scene largeTriangle(std::uint32_t resolution);

/// A square in the same plane over as many columns, of triangles that cover four each.
Scene smallTriangles(std::uint32_t resolution);

/// 400 slivers two voxels wide along the four diagonals of the grid, a hundred side by side along each.
Scene diagonalSlivers(std::uint32_t resolution);

/// 200,000 triangles (or, at a low resolution, an eighth of the grid's voxels) through the middle of one voxel.
Scene crowdedTriangles(std::uint32_t resolution);

/// The same triangles, each through the middle of a voxel of its own.
Scene spreadTriangles(std::uint32_t resolution);

} // namespace zvo::cli
