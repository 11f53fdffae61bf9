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

/// The vertices of a primitive after deformation.
struct DeformedVertices
{
    std::vector<glm::vec3> positions; // [vertices]
    std::vector<glm::vec3> normals;   // [vertices] of any length, or empty where the primitive has none and no joints
                                      // move it; a vertex without one has 0, or kTurnedRound
};

/// Stands in place of a normal: the vertex takes the normal of its triangle, turned round, because its joints mirror.
inline constexpr glm::vec3 kTurnedRound(-0x1p-120F, 0.0F, 0.0F);

/// The vertices of a primitive after morphing and skinning. morph_weights: [morph targets], missing ones count as 0.
/// joint_matrices: object to world, one for each joint of the skin; empty: no skin. Throws Error{Input} for a joint
/// that does not exist.
DeformedVertices deformVertices(const Primitive& primitive, std::span<const float> morph_weights,
                                std::span<const glm::mat4> joint_matrices);

/// Whether an instance of primitive has a skin or morph targets that deform it.
bool isDeformed(const Primitive& primitive, const Instance& instance);

/// The joints and weights of a vertex, in the form that the rule takes.
struct JointBinding
{
    glm::uvec4 joints; // 0 where the weight is 0
    glm::vec4 weights; // at least one is not 0
};

/// The binding of a vertex of a primitive with joints. Throws Error{Input} for a joint index of joint_count or more.
JointBinding bindingOf(const Primitive& primitive, std::size_t vertex, std::size_t joint_count);

/// value in the form that the rule takes: numbers that are too small to count become 0.
float withoutTiny(float value);
glm::vec3 withoutTiny(const glm::vec3& value);
glm::mat4x3 withoutTiny(const glm::mat4& transform); // without the last row

} // namespace zvo
