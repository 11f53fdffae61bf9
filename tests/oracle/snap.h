// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "oracle/coverage.h"

#include <array>
#include <glm/glm.hpp>

namespace zvo::oracle
{

/// A triangle on the lattice, or why there is none.
struct SnappedTriangle
{
    Triangle triangle{};
    const char* dropped = nullptr; // reason as docs/voxelization.md names it; null when kept
};

/// Brings the corners (object space) through transform onto grid's lattice. Where several reasons to drop a triangle
/// hold, the first of docs/voxelization.md's list counts.
SnappedTriangle snapTriangle(const std::array<glm::vec3, 3>& corners, const glm::mat4& transform, const Grid& grid,
                             Coverage coverage);

} // namespace zvo::oracle
