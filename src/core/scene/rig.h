// SPDX-License-Identifier: MIT
// What can move in a scene, as glTF has it: nodes, skins and key frames. core/scene/animation.h evaluates them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// An index that names nothing.
inline constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// The displacement that a morph target of weight 1 adds to each vertex, before skinning.
struct MorphTarget
{
    std::vector<glm::vec3> positions; // [vertices] or empty: nothing is added
    std::vector<glm::vec3> normals;   // [vertices] or empty; empty where the primitive has no normals
};

/// A node of the hierarchy. Its transform, relative to its parent, is translation * rotation * scale, or `matrix` where
/// that is given.
struct Node
{
    std::uint32_t parent = kNone; // index into Scene::nodes, below the node's own: parents stand before their children
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F}; // w, x, y, z; of any length, a zero one does not rotate
    glm::vec3 scale{1.0F};
    std::optional<glm::mat4> matrix;  // affine; no channel moves its node
    std::vector<float> morph_weights; // [targets of its mesh] at rest
    std::string name;
};

/// The joints of a mesh. A vertex is taken to the world by the weighted sum of world(joint) * inverse_bind.
struct Skin
{
    std::vector<std::uint32_t> joints;   // [joints] indices into Scene::nodes
    std::vector<glm::mat4> inverse_bind; // [joints] object to joint, affine
};

enum class ChannelPath : std::uint32_t
{
    Translation, // 3 numbers
    Rotation,    // 4 numbers: x, y, z, w
    Scale,       // 3 numbers
    Weights      // as many numbers as the node has morph weights
};

enum class Interpolation : std::uint32_t
{
    Step,
    Linear,     // rotations along the shorter arc (slerp)
    CubicSpline // Hermite; a key has an incoming tangent, a value and an outgoing tangent
};

/// Key frames of one property of one node.
struct Channel
{
    std::uint32_t node = 0; // index into Scene::nodes
    ChannelPath path = ChannelPath::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> times;  // [keys] at least one; finite seconds from 0 on, not descending
    std::vector<float> values; // [keys * numbers of the path], three times as many for CubicSpline; finite
};

struct Animation
{
    std::string name;
    std::vector<Channel> channels;
    double seconds = 0.0;     // the last time in any channel; the animation repeats after it
    std::uint32_t number = 0; // of the animation in its file; animations that move nothing are counted, too
};

/// translation * rotation * scale. rotation may have any length; one of length 0 does not rotate.
glm::dmat4 composeTransform(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale);

/// Whether the last row of a matrix is (0, 0, 0, 1), up to the rounding of exporters.
bool isAffine(const glm::dmat4& matrix);

/// The matrix with (0, 0, 0, 1) as its exact last row.
glm::dmat4 withAffineRow(glm::dmat4 matrix);

} // namespace zvo
