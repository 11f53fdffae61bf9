// SPDX-License-Identifier: MIT
// Filled trees against exact winding numbers and, where surfaces have holes, the rule for them.
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "oracle/coverage.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <cstdint>
#include <random>
#include <vector>

namespace zvo::test
{

/// The triangles of a scene on the lattice; none of them may be dropped.
std::vector<oracle::Triangle> latticeTriangles(const Scene& scene, const Grid& grid);

/// How a filled tree compares with what the winding numbers of its scene say.
struct FillComparison
{
    bool is_closed = false;     // the scene on the lattice, as winding numbers need
    std::uint64_t interior = 0; // voxels inside and not on the surface
    std::uint64_t undecided = 0;
    std::uint64_t wrong = 0;   // that are not where they should be, or missing; or the tree's count of them is wrong
    bool same_surface = false; // voxels of the surface, and their attributes, are those of the tree without filling;
                               // with Shell::None those of them that are inside
};

/// Builds and fills the scene's octree. Of scenes that are not closed, only that is told, but with Fill::Robust they
/// are compared as well; they must lie in the grid.
FillComparison compareFill(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
                           Fill fill, Shell shell = Shell::Surface);

/// Of the voxels that are inside the closed scene, the share that a fill of the scene with holes has wrong elsewhere
/// than on its surface; may be above 1.
double wrongOfHoles(vk::HeadlessDevice& device, const Scene& closed, const Scene& with_holes, const Grid& grid,
                    Fill fill);

/// The scene without that share of its triangles, picked at random.
Scene withHoles(Scene scene, std::mt19937& random, double share);

/// One to six tetrahedra, closed and anywhere in the grid, whose corners are multiples of 1, 32, 64, 128 or 256 lattice
/// units, so that lines through voxels' centres meet edges, corners and planes. The grid begins at 0, with voxels of 1.
Scene tetrahedra(std::mt19937& random, const Grid& grid);

} // namespace zvo::test
