// SPDX-License-Identifier: MIT
#include "core/scene/animation.h"

#include "core/scene/deform.h"
#include "core/scene/scene_size.h"
#include "zvo/error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace zvo
{

namespace
{

/// Two neighbouring keys and where a time lies between them; twice the same one before the first and after the last.
struct KeySpan
{
    std::size_t first = 0;
    std::size_t second = 0;
    double fraction = 0.0; // 0 at the first key, below 1
    double seconds = 0.0;  // from the first to the second
};

KeySpan findKeys(const std::vector<float>& times, double seconds)
{
    const auto after = std::upper_bound(times.begin(), times.end(), seconds);
    if (after == times.begin())
    {
        return {};
    }
    const auto first = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end())
    {
        return {first, first};
    }
    const double begin = times[first];
    const double length = static_cast<double>(*after) - begin;
    return {first, first + 1, (seconds - begin) / length, length};
}

/// Of any length, a zero one as no rotation.
glm::dvec4 normalized(const glm::dvec4& quaternion)
{
    const double length = std::sqrt(glm::dot(quaternion, quaternion));
    return length > 0.0 ? quaternion / length : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

/// From a to b along the shorter arc. After: Ken Shoemake, Animating Rotation with Quaternion Curves, 1985.
glm::dvec4 slerp(glm::dvec4 a, glm::dvec4 b, double fraction)
{
    a = normalized(a);
    b = normalized(b);
    b = glm::dot(a, b) < 0.0 ? -b : b;
    const double angle = 2.0 * std::atan2(glm::length(b - a), glm::length(b + a)); // at most a quarter turn
    const double sine = std::sin(angle);
    return sine > 0.0 ? (a * std::sin((1.0 - fraction) * angle) + b * std::sin(fraction * angle)) / sine : a;
}

/// The value of channel at a time in its animation.
void sample(const Channel& channel, double seconds, std::span<double> value)
{
    const std::size_t size = value.size();
    const bool has_tangents = channel.interpolation == Interpolation::CubicSpline;
    const std::size_t numbers_per_key = has_tangents ? 3 * size : size;
    assert(!channel.times.empty() && channel.values.size() == channel.times.size() * numbers_per_key);
    const KeySpan keys = findKeys(channel.times, seconds);
    const float* first = channel.values.data() + keys.first * numbers_per_key + (has_tangents ? size : 0);
    const float* second = channel.values.data() + keys.second * numbers_per_key + (has_tangents ? size : 0);
    const double t = keys.fraction;
    if (channel.interpolation == Interpolation::Step || keys.first == keys.second)
    {
        std::copy(first, first + size, value.begin());
    }
    else if (has_tangents)
    {
        const double t2 = t * t;
        const double t3 = t2 * t;
        for (std::size_t i = 0; i < size; ++i)
        {
            const double leaving = keys.seconds * first[size + i];
            const double arriving = keys.seconds * *(second - size + i);
            value[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * first[i] + (t3 - 2.0 * t2 + t) * leaving +
                       (3.0 * t2 - 2.0 * t3) * second[i] + (t3 - t2) * arriving;
        }
    }
    else if (channel.path == ChannelPath::Rotation)
    {
        const glm::dvec4 turned = slerp(glm::dvec4(first[0], first[1], first[2], first[3]),
                                        glm::dvec4(second[0], second[1], second[2], second[3]), t);
        for (int i = 0; i < 4; ++i)
        {
            value[i] = turned[i];
        }
    }
    else
    {
        for (std::size_t i = 0; i < size; ++i)
        {
            value[i] = (1.0 - t) * first[i] + t * second[i];
        }
    }
}

/// A node between key frames.
struct LocalPose
{
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dvec3 scale;
};

double repeated(double seconds, double length)
{
    if (!std::isfinite(seconds) || !(length > 0.0))
    {
        return 0.0;
    }
    const double rest = std::fmod(seconds, length);
    const double wrapped = rest < 0.0 ? rest + length : rest;
    return wrapped < length ? wrapped : 0.0; // a sum may be rounded up
}

/// All nodes of a scene at a time.
class NodePoses
{
public:
    NodePoses(const Scene& scene, double seconds, const glm::dmat4& to_world)
    {
        for (const Node& node : scene.nodes)
        {
            m_locals.push_back({node.translation, node.rotation, node.scale});
            m_weights.push_back(node.morph_weights);
        }
        for (const Animation& animation : scene.animations)
        {
            const double time = repeated(seconds, animation.seconds);
            for (const Channel& channel : animation.channels)
            {
                apply(channel, time);
            }
        }
        for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        {
            const Node& node = scene.nodes[i];
            assert(node.parent == kNone || node.parent < i);
            const LocalPose& local = m_locals[i];
            const glm::dmat4 matrix = node.matrix ? glm::dmat4(*node.matrix)
                                                  : composeTransform(local.translation, local.rotation, local.scale);
            m_to_world.push_back((node.parent == kNone ? to_world : m_to_world[node.parent]) * matrix);
        }
    }

    [[nodiscard]] const glm::dmat4& toWorld(std::uint32_t node) const { return m_to_world[node]; }
    [[nodiscard]] const std::vector<float>& morphWeights(std::uint32_t node) const { return m_weights[node]; }

private:
    void apply(const Channel& channel, double time)
    {
        LocalPose& local = m_locals[channel.node];
        double value[4] = {};
        switch (channel.path)
        {
        case ChannelPath::Translation:
            sample(channel, time, std::span(value, 3));
            local.translation = {value[0], value[1], value[2]};
            return;
        case ChannelPath::Rotation:
            sample(channel, time, value);
            local.rotation = glm::dquat(value[3], value[0], value[1], value[2]);
            return;
        case ChannelPath::Scale:
            sample(channel, time, std::span(value, 3));
            local.scale = {value[0], value[1], value[2]};
            return;
        case ChannelPath::Weights:
            std::vector<float>& weights = m_weights[channel.node];
            std::vector<double> values(weights.size());
            sample(channel, time, values);
            std::transform(values.begin(), values.end(), weights.begin(),
                           [](double weight) { return static_cast<float>(weight); });
            return;
        }
    }

    std::vector<LocalPose> m_locals;           // [nodes]
    std::vector<std::vector<float>> m_weights; // [nodes]
    std::vector<glm::dmat4> m_to_world;        // [nodes]
};

/// Which nodes channels move, and of which they change the morph weights.
struct AnimatedNodes
{
    explicit AnimatedNodes(const Scene& scene) : moved(scene.nodes.size(), false), weighted(scene.nodes.size(), false)
    {
        for (const Animation& animation : scene.animations)
        {
            for (const Channel& channel : animation.channels)
            {
                (channel.path == ChannelPath::Weights ? weighted : moved)[channel.node] = true;
            }
        }
        for (std::size_t i = 0; i < scene.nodes.size(); ++i) // parents come first
        {
            const std::uint32_t parent = scene.nodes[i].parent;
            moved[i] = moved[i] || (parent != kNone && moved[parent]);
        }
    }

    std::vector<bool> moved;    // [nodes] by a channel of the node or of one above it
    std::vector<bool> weighted; // [nodes]
};

/// Joint matrices, once for each skin.
std::vector<std::vector<glm::mat4>> jointMatrices(const Scene& scene, const NodePoses& nodes)
{
    std::vector<std::vector<glm::mat4>> matrices(scene.skins.size());
    for (std::size_t i = 0; i < scene.skins.size(); ++i)
    {
        const Skin& skin = scene.skins[i];
        for (std::size_t k = 0; k < skin.joints.size(); ++k)
        {
            const glm::dmat4 matrix = nodes.toWorld(skin.joints[k]) * glm::dmat4(skin.inverse_bind[k]);
            matrices[i].emplace_back(withAffineRow(matrix));
        }
    }
    return matrices;
}

/// primitive without what deforms it, and without positions and normals.
Primitive surfaceOf(const Primitive& primitive)
{
    Primitive surface;
    surface.uvs = primitive.uvs;
    surface.emission_uvs = primitive.emission_uvs;
    surface.colors = primitive.colors;
    surface.triangles = primitive.triangles;
    surface.material = primitive.material;
    surface.is_points = primitive.is_points;
    return surface;
}

/// Throws where instances that deform take more memory than a scene may.
void checkPosedSize(const Scene& scene)
{
    double bytes = 0;
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        if (isDeformed(primitive, instance))
        {
            bytes += static_cast<double>(primitive.positions.size()) * 2 * sizeof(glm::vec3) +
                     static_cast<double>(primitive.uvs.size() + primitive.emission_uvs.size()) * sizeof(glm::vec2) +
                     static_cast<double>(primitive.colors.size()) * sizeof(glm::vec4) +
                     static_cast<double>(primitive.triangles.size()) * sizeof(glm::uvec3);
        }
    }
    if (const std::uint64_t bytes_max = sceneBytesMax(); bytes > static_cast<double>(bytes_max))
    {
        throw Error(ErrorCode::Memory,
                    fmt::format("meshes that skins and morph targets deform take {:.3g} bytes, more than the {} that "
                                "half of this machine's memory has; show fewer of them",
                                bytes, bytes_max));
    }
}

} // namespace

bool keepAnimation(Scene& scene, const std::optional<AnimationChoice>& choice)
{
    const auto isWanted = [&choice](const Animation& animation)
    {
        if (!choice)
        {
            return true;
        }
        const auto* const name = std::get_if<std::string>(&*choice);
        return name != nullptr ? !name->empty() && animation.name == *name
                               : animation.number == std::get<std::uint32_t>(*choice);
    };
    const auto wanted = std::find_if(scene.animations.begin(), scene.animations.end(), isWanted);
    if (wanted == scene.animations.end())
    {
        return !choice;
    }
    std::vector<Animation> kept;
    kept.push_back(std::move(*wanted));
    scene.animations = std::move(kept);
    return true;
}

Pose poseAt(const Scene& scene, double seconds, const glm::dmat4& to_world)
{
    const NodePoses nodes(scene, seconds, to_world);
    const AnimatedNodes animated(scene);
    const std::vector<std::vector<glm::mat4>> joint_matrices = jointMatrices(scene, nodes);
    const bool is_moved = to_world != glm::dmat4(1.0);
    Pose pose;
    for (const Instance& instance : scene.instances)
    {
        const std::size_t target_count = scene.primitives[instance.primitive].morph_targets.size();
        glm::mat4& transform = pose.transforms.emplace_back(1.0F);
        std::vector<glm::mat4>& joints = pose.joint_matrices.emplace_back();
        std::vector<float>& weights = pose.morph_weights.emplace_back();
        if (instance.skin != kNone)
        {
            joints = joint_matrices[instance.skin];
        }
        else if (instance.node != kNone && animated.moved[instance.node])
        {
            transform = glm::mat4(withAffineRow(nodes.toWorld(instance.node) * glm::dmat4(instance.in_node)));
        }
        else
        {
            transform =
                is_moved ? glm::mat4(withAffineRow(to_world * glm::dmat4(instance.transform))) : instance.transform;
        }
        if (instance.node != kNone && target_count > 0)
        {
            weights = nodes.morphWeights(instance.node);
        }
        weights.resize(target_count);
    }
    return pose;
}

bool isAnimated(const Scene& scene, std::size_t instance)
{
    return animatedInstances(scene)[instance];
}

std::vector<bool> animatedInstances(const Scene& scene)
{
    const AnimatedNodes nodes(scene);
    std::vector<bool> moved_skins;
    for (const Skin& skin : scene.skins)
    {
        moved_skins.push_back(std::any_of(skin.joints.begin(), skin.joints.end(),
                                          [&](std::uint32_t joint) { return nodes.moved[joint]; }));
    }
    std::vector<bool> animated;
    for (const Instance& instance : scene.instances)
    {
        const bool has_targets = !scene.primitives[instance.primitive].morph_targets.empty();
        const bool is_moved = instance.node != kNone && nodes.moved[instance.node];
        const bool is_morphed = instance.node != kNone && has_targets && nodes.weighted[instance.node];
        animated.push_back(is_moved || is_morphed || (instance.skin != kNone && moved_skins[instance.skin]));
    }
    return animated;
}

Scene posedScene(const Scene& scene, const Pose& pose)
{
    assert(pose.transforms.size() == scene.instances.size());
    checkPosedSize(scene);
    Scene posed;
    posed.images = scene.images;
    posed.textures = scene.textures;
    posed.materials = scene.materials;
    posed.cameras = scene.cameras;
    posed.warnings = scene.warnings;
    std::vector<std::uint32_t> rigid(scene.primitives.size(), kNone); // indices into posed.primitives
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        const Instance& instance = scene.instances[i];
        const Primitive& primitive = scene.primitives[instance.primitive];
        const bool is_deformed = isDeformed(primitive, instance);
        std::uint32_t index = is_deformed ? kNone : rigid[instance.primitive];
        if (index == kNone)
        {
            index = static_cast<std::uint32_t>(posed.primitives.size());
            Primitive surface = surfaceOf(primitive);
            if (is_deformed)
            {
                DeformedVertices vertices = deformVertices(primitive, pose.morph_weights[i], pose.joint_matrices[i]);
                surface.positions = std::move(vertices.positions);
                surface.normals = std::move(vertices.normals);
            }
            else
            {
                surface.positions = primitive.positions;
                surface.normals = primitive.normals;
                rigid[instance.primitive] = index;
            }
            posed.primitives.push_back(std::move(surface));
        }
        posed.instances.push_back({index, pose.transforms[i]});
    }
    return posed;
}

} // namespace zvo
