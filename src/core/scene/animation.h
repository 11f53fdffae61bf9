// SPDX-License-Identifier: MIT
// Scenes in motion: key frames and node hierarchies (core/scene/rig.h) evaluated at a time, after the glTF 2.0
// specification (Khronos Group, 2021), sections "Skins", "Morph Targets" and "Animations" and appendix C,
// "Interpolation Modes".
#pragma once

#include "core/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace zvo
{

/// Where the instances of a scene are, and into which shape they are pulled, at one time.
struct Pose
{
    std::vector<glm::mat4> transforms; // [instances] object to world, affine; the identity for those with a skin
    std::vector<std::vector<glm::mat4>> joint_matrices; // [instances][joints of its skin] object to world, affine:
                                                        // world(joint) * inverse_bind; empty without a skin
    std::vector<std::vector<float>> morph_weights;      // [instances][morph targets of its primitive]
};

/// Which animation of a file plays: the first of that name, or the one of that number (Animation::number).
using AnimationChoice = std::variant<std::string, std::uint32_t>;

/// Takes all animations from the scene of one file but the one that plays: the chosen one or else the first. Whether
/// the chosen one is there; if not, nothing changes.
bool keepAnimation(Scene& scene, const std::optional<AnimationChoice>& choice = std::nullopt);

/// The pose at a time from 0 on or before it, with every animation of the scene repeated over its own length; before
/// its first key a channel holds the first one. Of channels of several animations that move the same property the last
/// one counts. Instances that nothing moves keep their transform, bit for bit; others follow their node. Nodes are
/// evaluated in double precision. A time that is not finite counts as 0. A transform that overflows single precision
/// is not finite; the voxelizer drops such triangles and counts them. to_world: the transform of the scene, affine; it
/// comes after everything else.
Pose poseAt(const Scene& scene, double seconds, const glm::dmat4& to_world = glm::dmat4(1.0));

/// Whether the instance may change with time: a channel moves its node, one above it, or a joint of its skin or one
/// above that, or the weights of its morph targets.
bool isAnimated(const Scene& scene, std::size_t instance);

/// isAnimated() of all instances, in time proportional to the scene.
std::vector<bool> animatedInstances(const Scene& scene);

/// The scene as it stands in a pose, without nodes, skins, animations and morph targets: each instance that deforms
/// (isDeformed()) has a primitive of its own, with the positions and normals that the device makes of it
/// (core/scene/deform.h), bit for bit; such normals have any length. Instances and cameras keep their order, cameras
/// their place. pose: of this scene. Throws Error{Memory} where these primitives take more than half of this machine's
/// memory.
Scene posedScene(const Scene& scene, const Pose& pose);

} // namespace zvo
