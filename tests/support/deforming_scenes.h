// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/animation.h"
#include "core/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <random>

namespace zvo::test
{

/// The vertex attributes and targets of a deforming primitive.
struct DeformingParts
{
    bool normals = true;
    std::size_t joint_count = 0; // 0: no skin
    std::size_t target_count = 0;
};

/// A primitive of vertex_count random vertices, most of them near the origin; any three in a row form a triangle. Every
/// fourth vertex has one joint, the others have up to four. Some targets lack positions or normals.
Primitive deformingPrimitive(std::mt19937& random, std::size_t vertex_count, const DeformingParts& parts);

/// A random affine matrix: rotation, uneven scale, shear, a mirroring half of the time, and a translation of up to
/// distance.
glm::mat4 randomAffine(std::mt19937& random, float distance);

/// Adds an instance of a primitive to scene, and its transform or joint matrices to pose. joint_count: as of the
/// primitive; 0: the instance gets a transform and no skin.
void addDeforming(std::mt19937& random, Scene& scene, Pose& pose, std::uint32_t primitive, std::size_t joint_count);

/// Replaces all joint matrices, weights and transforms of pose; some weights become 0.
void changePose(std::mt19937& random, Pose& pose);

} // namespace zvo::test
