// SPDX-License-Identifier: MIT
// Squared distances of points to triangles in integers of any length (docs/voxelization.md, Distance).
#pragma once

#include "oracle/coverage.h"

#include <cstdint>

namespace zvo::oracle
{

/// floor(256 d^2) for the distance d of a point to a triangle, which may be a segment or a point, in lattice units; or
/// UINT32_MAX where that is `limit` or more.
std::uint32_t squaredDistance(const Vec& point, const Triangle& triangle, std::uint32_t limit);

} // namespace zvo::oracle
