// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"

#include <array>
#include <optional>

namespace zvo
{

/// The corners of a triangle on the lattice of a grid.
using LatticeCorners = std::array<glm::i64vec3, 3>;

/// The cross product of the edges from the first corner to the second and to the third.
glm::i64vec3 normalOf(const LatticeCorners& corners);

/// A triangle of a primitive, snapped as shaders/voxelize/vertex.glsl does. Nothing where a corner has no place on the
/// lattice, or the triangle's box does not touch the grid.
std::optional<LatticeCorners> latticeCorners(const Primitive& primitive, const glm::uvec3& triangle,
                                             const glm::mat4& transform, const Grid& grid);

} // namespace zvo
