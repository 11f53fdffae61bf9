// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/animation.h"
#include "core/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <random>

namespace zvo::test
{

/// What the vertices of a deforming primitive have.
struct DeformingParts
{
    bool normals = true;
    std::size_t joint_count = 0; // 0: no skin
    std::size_t target_count = 0;
};

/// A primitive of vertex_count random vertices, most of them near the origin, in triangles of three in a row. Every
/// fourth vertex hangs on one joint, some on two of four weights; some targets have no deltas of their kind.
Primitive deformingPrimitive(std::mt19937& random, std::size_t vertex_count, const DeformingParts& parts);

/// A random affine matrix: turned, scaled unevenly, sheared, mirrored half of the time, moved by up to distance.
glm::mat4 randomAffine(std::mt19937& random, float distance);

/// An instance of a primitive, and where it is in pose. joint_count: as of the primitive; 0: the instance gets a
/// transform and no skin.
void addDeforming(std::mt19937& random, Scene& scene, Pose& pose, std::uint32_t primitive, std::size_t joint_count);

/// Other joint matrices, weights and transforms for what pose has, weights of 0 among them.
void changePose(std::mt19937& random, Pose& pose);

} // namespace zvo::test
