// SPDX-License-Identifier: MIT
// The voxels that a snapped triangle covers, after docs/voxelization.md. Conservative coverage uses the separating axis
// theorem (Gottschalk, Lin and Manocha, OBBTree, 1996) in the form for triangle and box (Akenine-Möller, Fast 3D
// Triangle-Box Overlap Testing, 2001). Thin coverage evaluates the inequalities of the page, one by one.
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

/// The parts of the thin rule that are conventions; docs/voxelization.md defines the default. An axis symmetry of the
/// grid turns one convention into another. The thin set of a mirrored triangle is the mirrored thin set under that
/// other convention.
struct ThinRule
{
    /// Among axes with equal |normal|, the first in this order is the major one.
    std::array<std::uint32_t, 3> tie_order{0, 1, 2};
    /// By major axis: a plane at a border between layers belongs to the lower one.
    std::array<bool, 3> border_below{};
};

/// The axis with the largest |normal|; among equal ones the first in tie_order.
std::uint32_t majorAxis(const Vec& normal, const std::array<std::uint32_t, 3>& tie_order = {0, 1, 2});

/// Whether the closed triangle and the closed box have a common point. Tests all thirteen axes.
bool overlaps(const Triangle& triangle, const Box& box);

/// The thin rule for one voxel of a grid of resolution^3. A triangle without area covers nothing.
bool coversThin(const Triangle& triangle, const glm::uvec3& voxel, std::uint32_t resolution, const ThinRule& rule = {});

/// The closed box of voxels first to last, both included.
Box voxelBox(const glm::uvec3& first, const glm::uvec3& last);

/// Calls visit(voxel) once for each covered voxel of the grid, in no particular order. Skips blocks of voxels that the
/// triangle misses by the thirteen axes.
void forEachCoveredVoxel(const Triangle& triangle, std::uint32_t resolution, Coverage coverage,
                         const std::function<void(const glm::uvec3&)>& visit, const ThinRule& rule = {});

} // namespace zvo::oracle
