// SPDX-License-Identifier: MIT
// Which voxels a snapped triangle covers, after docs/voxelization.md. Conservative: the separating axis theorem
// (Gottschalk, Lin and Manocha, OBBTree, 1996) in the form for triangle and box (Akenine-Möller, Fast 3D Triangle-Box
// Overlap Testing, 2001). Thin: the page's own inequalities, one by one.
#pragma once

#include "oracle/exact.h"
#include "zvo/types.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

namespace zvo::oracle
{

constexpr int kLatticeVoxel = 256; // lattice units per voxel

/// Three lattice points.
using Triangle = std::array<Vec, 3>;

/// The closed box from low to high, in lattice units.
struct Box
{
    Vec low;
    Vec high;
};

/// (V1 - V0) x (V2 - V0): zero when the points lie on one line.
Vec normalOf(const Triangle& triangle);

/// What the thin rule leaves to convention. The definition has the default; an axis symmetry of the grid turns it into
/// another one, and the thin set of the image is the image of the thin set under that one.
struct ThinRule
{
    std::array<std::uint32_t, 3> tie_order{0, 1, 2}; // of axes with equal |normal| the first in this order is the major
    std::array<bool, 3> border_below{}; // by major axis: a plane at a border between layers belongs to the lower one
};

/// The axis with the largest |normal|; of equal ones the first in tie_order.
std::uint32_t majorAxis(const Vec& normal, const std::array<std::uint32_t, 3>& tie_order = {0, 1, 2});

/// Whether the closed triangle and the closed box have a point in common: all thirteen axes.
bool overlaps(const Triangle& triangle, const Box& box);

/// The thin rule for one voxel of a grid of resolution^3; a triangle without area covers nothing.
bool coversThin(const Triangle& triangle, const glm::uvec3& voxel, std::uint32_t resolution, const ThinRule& rule = {});

/// The closed box of voxels first to last (both included).
Box voxelBox(const glm::uvec3& first, const glm::uvec3& last);

/// Calls visit(voxel) once for each covered voxel of the grid, in no particular order. Looks only where the triangle
/// touches blocks of voxels, by the same thirteen axes.
void forEachCoveredVoxel(const Triangle& triangle, std::uint32_t resolution, Coverage coverage,
                         const std::function<void(const glm::uvec3&)>& visit, const ThinRule& rule = {});

} // namespace zvo::oracle
