// SPDX-License-Identifier: MIT
// What is inside surfaces with holes, by the rule of docs/voxelization.md: voxel by voxel, without digits and bricks.
#pragma once

#include "oracle/coverage.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo::oracle
{

/// For each voxel of a grid of resolution^3, x fastest, that is not on the surface: 1 inside, -1 outside, 0 undecided.
/// on_surface: as many. The triangles must lie in the grid.
std::vector<std::int8_t> robustSides(std::span<const Triangle> triangles, const std::vector<bool>& on_surface,
                                     std::uint32_t resolution);

} // namespace zvo::oracle
