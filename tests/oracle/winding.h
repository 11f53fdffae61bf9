// SPDX-License-Identifier: MIT
// What lies inside a closed surface, counted exactly: it says nothing about voxels being covered.
#pragma once

#include "oracle/coverage.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo::oracle
{

/// Every directed edge, by the places of its ends, has as many partners in the other direction.
bool isClosed(std::span<const Triangle> triangles);

/// Winding numbers of a closed surface around the voxels' centres of a grid of resolution^3, x fastest: 0 outside; 1
/// inside of a simple surface whose triangles turn counterclockwise seen from outside. Counts the crossings below each
/// centre (integers alone; a column that meets an edge or a vertex counts as moved by less than anything, the same way
/// for all triangles). For centres on the surface the number means nothing.
std::vector<std::int16_t> windingNumbers(std::span<const Triangle> triangles, std::uint32_t resolution);

} // namespace zvo::oracle
