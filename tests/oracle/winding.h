// SPDX-License-Identifier: MIT
// Exact winding numbers around voxels' centres, which are independent of coverage.
#pragma once

#include "oracle/coverage.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo::oracle
{

/// Whether every directed edge, identified by the positions of its ends, has as many partners in the other direction.
bool isClosed(std::span<const Triangle> triangles);

/// Winding numbers of a closed surface around the centres of the voxels of a grid of resolution^3, x fastest. 0 is
/// outside; 1 is inside of a simple surface whose triangles turn counterclockwise seen from outside. They count the
/// crossings below each centre, in integers; a column that meets an edge or a vertex counts as moved by an
/// infinitesimal distance, the same for all triangles. For centres on the surface the number has no meaning.
std::vector<std::int16_t> windingNumbers(std::span<const Triangle> triangles, std::uint32_t resolution);

/// The same around points next to the centres: e along x, e^2 along z and e^3 along y from them, for an e smaller than
/// any number, so that no point is on a triangle. They count the crossings above each point along y, a triangle that
/// faces up as 1; of surfaces that are not closed, too.
std::vector<std::int16_t> windingsBesideCentres(std::span<const Triangle> triangles, std::uint32_t resolution);

} // namespace zvo::oracle
