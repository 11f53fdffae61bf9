// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstddef>
#include <span>

namespace zvo::oracle
{

/// A vertex deformed in double precision, and bounds on the error of single precision.
struct DeformedVertex
{
    glm::dvec3 position{0.0};
    glm::dvec3 position_bound{0.0};
    glm::dvec3 normal{0.0}; // unit length
    // The distance from normal to the unit vector in the direction that single precision finds. It is infinite if
    // single precision may find any direction, or if there is no normal.
    double normal_bound = 0;
    int side = 1; // -1: the joints mirror; 0: single precision may find either sign
};

/// Deforms a vertex of primitive by finite morph weights and finite joint matrices (empty: none). Independent of the
/// rule in docs/deformation.md: matrices are blended first, and normals go through the inverse transpose. The bounds
/// allow a few roundings of 2^-24 for every operation that the rule may take.
DeformedVertex deformVertex(const Primitive& primitive, std::size_t vertex, std::span<const float> morph_weights,
                            std::span<const glm::mat4> joints);

} // namespace zvo::oracle
