// SPDX-License-Identifier: MIT
// Morph targets and skins on the CPU: the rule of docs/deformation.md, which the device follows with the same bits.
#pragma once

#include "core/scene/scene.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo
{

/// Vertices of a primitive that was deformed.
struct DeformedVertices
{
    std::vector<glm::vec3> positions; // [vertices]
    std::vector<glm::vec3> normals;   // [vertices] of any length, or empty where the primitive has none and no joints
                                      // move it; a vertex without one has 0, or kTurnedRound
};

/// In place of a normal: the vertex takes that of its triangle, turned round because its joints mirror.
inline constexpr glm::vec3 kTurnedRound(-0x1p-120F, 0.0F, 0.0F);

/// The vertices of primitive with morph_weights ([morph targets]; missing ones are 0) and hung on the joints of a skin
/// (object to world; empty: on none). Throws Error{Input} for a joint that is not there.
DeformedVertices deformVertices(const Primitive& primitive, std::span<const float> morph_weights,
                                std::span<const glm::mat4> joint_matrices);

/// Whether a skin or morph targets deform an instance of primitive.
bool isDeformed(const Primitive& primitive, const Instance& instance);

/// What a vertex hangs on, as the rule takes it.
struct JointBinding
{
    glm::uvec4 joints; // 0 where the weight is 0
    glm::vec4 weights; // at least one is not 0
};

/// The binding of a vertex of a primitive with joints. Throws Error{Input} for a joint that is not below joint_count.
JointBinding bindingOf(const Primitive& primitive, std::size_t vertex, std::size_t joint_count);

/// value as the rule takes it: 0 where it is too small to count.
float withoutTiny(float value);
glm::vec3 withoutTiny(const glm::vec3& value);
glm::mat4x3 withoutTiny(const glm::mat4& transform); // without the last row

} // namespace zvo
