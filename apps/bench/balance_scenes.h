// SPDX-License-Identifier: MIT
// Scenes that test load balance, for a grid with its corner at the origin and voxels of size 1.
#pragma once

#include "core/scene/scene.h"

#include <cstdint>

namespace zvo::cli
{

/// A tilted triangle over about (resolution / 2)^2 columns: 1024^2 at a resolution of 2048.
Scene largeTriangle(std::uint32_t resolution);

/// A square in the same plane over as many columns, made of triangles that cover four columns each.
Scene smallTriangles(std::uint32_t resolution);

/// 400 slivers, two voxels wide, along the four diagonals of the grid: a hundred side by side along each.
Scene diagonalSlivers(std::uint32_t resolution);

/// 200,000 triangles through the middle of one voxel; at low resolutions, as many as an eighth of the grid's voxels.
Scene crowdedTriangles(std::uint32_t resolution);

/// The same triangles, each through the middle of its own voxel.
Scene spreadTriangles(std::uint32_t resolution);

/// As many triangles through the middles of the voxels of one brick, a block of 16^3, in turns.
Scene brickTriangles(std::uint32_t resolution);

/// 2,000 slivers, two voxels wide, from the grid's middle in all directions: all touch the brick there.
Scene fanOfSlivers(std::uint32_t resolution);

/// 100,000 boxes on a lattice; at low resolutions, as many as there are blocks of 4^3 voxels.
Scene manyBoxes(std::uint32_t resolution);

} // namespace zvo::cli
