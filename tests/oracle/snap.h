// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "oracle/coverage.h"

#include <array>
#include <glm/glm.hpp>

namespace zvo::oracle
{

/// A triangle on the lattice, or the reason why there is none.
struct SnappedTriangle
{
    Triangle triangle{};
    const char* dropped = nullptr; // reason as docs/voxelization.md names it; null if the triangle is kept
};

/// Transforms corners from object space and rounds them to grid's lattice. If there are several reasons to drop a
/// triangle, the first in the list of docs/voxelization.md counts.
SnappedTriangle snapTriangle(const std::array<glm::vec3, 3>& corners, const glm::mat4& transform, const Grid& grid,
                             Coverage coverage);

} // namespace zvo::oracle
