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

/// The positions of a scene's instances, and their deformation, at one time.
struct Pose
{
    std::vector<glm::mat4> transforms; // [instances] object to world, affine; the identity for those with a skin
    std::vector<std::vector<glm::mat4>> joint_matrices; // [instances][joints of its skin] object to world, affine:
                                                        // world(joint) * inverse_bind; empty without a skin
    std::vector<std::vector<float>> morph_weights;      // [instances][morph targets of its primitive]
};

/// The animation of a file that is to play: the first one of that name, or the one with that Animation::number.
using AnimationChoice = std::variant<std::string, std::uint32_t>;

/// Removes all animations of a file's scene but the one that is to play: the chosen one or, without a choice, the
/// first. Returns whether the chosen animation exists; if it does not, nothing changes.
bool keepAnimation(Scene& scene, const std::optional<AnimationChoice>& choice = std::nullopt);

/// The pose at a time, which may be negative. Every animation of the scene repeats over its own length; before its
/// first key a channel has the value of that key. Where channels of several animations move the same property, the last
/// one counts. Instances that nothing moves keep their transform, bit for bit; others follow their node, evaluated in
/// double precision. A time that is not finite counts as 0. A transform that overflows single precision is not finite;
/// the voxelizer drops and counts its triangles. to_world: an affine transform of the whole scene, applied last.
Pose poseAt(const Scene& scene, double seconds, const glm::dmat4& to_world = glm::dmat4(1.0));

/// Whether an instance may change with time: because a channel moves its node or a node above it, a joint of its skin
/// or a node above the joint, or the weights of its morph targets.
bool isAnimated(const Scene& scene, std::size_t instance);

/// isAnimated() of all instances, in time proportional to the size of the scene.
std::vector<bool> animatedInstances(const Scene& scene);

/// The scene as it stands in a pose, without nodes, skins, animations and morph targets. Each instance that deforms
/// (isDeformed()) has a primitive of its own, with the same positions and normals, bit for bit, as the device makes
/// (core/scene/deform.h); such normals may have any length. Instances and cameras keep their order, and cameras their
/// transforms. pose: a pose of this scene. Throws Error{Memory} where the new primitives take more than half of this
/// machine's memory.
Scene posedScene(const Scene& scene, const Pose& pose);

} // namespace zvo
