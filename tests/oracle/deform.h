// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstddef>
#include <span>

namespace zvo::oracle
{

/// A vertex deformed in double precision, and how far single precision may be from it.
struct DeformedVertex
{
    glm::dvec3 position{0.0};
    glm::dvec3 position_bound{0.0};
    glm::dvec3 normal{0.0};  // unit length
    double normal_bound = 0; // distance from normal of the unit vector in the direction that single precision finds;
                             // infinite where single precision may find any, or there is none
    int side = 1;            // -1: the joints mirror; 0: single precision may find either
};

/// Vertex of primitive with finite morph weights, hung on the finite matrices joints (empty: on none). Independent of
/// the rule in docs/deformation.md: the matrices are blended first, normals go through the inverse transpose. The
/// bounds hold for a few roundings of 2^-24 each for every operation that the rule may take on the way.
DeformedVertex deformVertex(const Primitive& primitive, std::size_t vertex, std::span<const float> morph_weights,
                            std::span<const glm::mat4> joints);

} // namespace zvo::oracle
