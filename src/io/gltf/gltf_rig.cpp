// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_rig.h"

#include "io/gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

namespace zvo
{

namespace
{

bool allFinite(const std::vector<float>& numbers)
{
    return std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
}

template <typename Value>
std::optional<Value> named(std::initializer_list<std::pair<std::string_view, Value>> values, std::string_view name)
{
    const auto* const found = std::ranges::find(values, name, &std::pair<std::string_view, Value>::first);
    return found != values.end() ? std::optional(found->second) : std::nullopt;
}

std::optional<ChannelPath> toPath(std::string_view path)
{
    return named<ChannelPath>({{"translation", ChannelPath::Translation},
                               {"rotation", ChannelPath::Rotation},
                               {"scale", ChannelPath::Scale},
                               {"weights", ChannelPath::Weights}},
                              path);
}

std::optional<Interpolation> toInterpolation(std::string_view interpolation)
{
    return named<Interpolation>(
        {{"STEP", Interpolation::Step}, {"LINEAR", Interpolation::Linear}, {"CUBICSPLINE", Interpolation::CubicSpline}},
        interpolation);
}

/// Whether glTF allows the accessor's type for values of that path.
bool fitsPath(const GltfAccessor& values, ChannelPath path)
{
    const bool may_be_whole = path == ChannelPath::Rotation || path == ChannelPath::Weights;
    const bool is_whole = values.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT;
    const std::uint32_t wanted = path == ChannelPath::Rotation ? 4 : path == ChannelPath::Weights ? 1 : 3;
    return values.component_count == wanted && values.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT &&
           (may_be_whole || !is_whole);
}

/// Reads the key frames of channel, whose other members are set. numbers_per_key: components of a value. Returns the
/// fault, or "" if they can be used.
std::string readKeys(const GltfDocument& document, const GltfChannelSource& source, std::size_t numbers_per_key,
                     const std::string& where, Channel& channel)
{
    const GltfAccessor times = openAccessor(document, source.input, "input of " + where);
    GltfAccessor values = openAccessor(document, source.output, "output of " + where);
    if (times.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT || times.component_count != 1 ||
        !fitsPath(values, channel.path))
    {
        return "its times or values have a type that glTF does not allow there";
    }
    const std::size_t tangents = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
    // Division is used because the product may exceed 64 bits.
    const std::size_t number_count = values.count * values.component_count;
    if (times.count == 0 || number_count % times.count != 0 || number_count / times.count != tangents * numbers_per_key)
    {
        return "it does not have a value for each time";
    }
    values.normalized = true; // integers are normalized even if the file does not say so
    channel.times = readNumbers(times);
    channel.values = readNumbers(values);
    if (!allFinite(channel.times) || channel.times.front() < 0.0F ||
        !std::is_sorted(channel.times.begin(), channel.times.end()))
    {
        return "its times do not increase from 0 on";
    }
    return allFinite(channel.values) ? "" : "its values are not finite";
}

} // namespace

std::size_t gltfTargetCount(const tinygltf::Mesh& mesh)
{
    std::size_t count = 0;
    for (const tinygltf::Primitive& primitive : mesh.primitives)
    {
        count = std::max(count, primitive.targets.size());
    }
    return count;
}

GltfRig::GltfRig(const GltfDocument& document, std::span<const GltfPlacedNode> nodes, Scene& scene,
                 GltfWarnings& warnings)
    : m_document(document), m_scene(scene), m_warnings(warnings), m_nodes(document.model.nodes.size(), kNone)
{
    m_scene.nodes.reserve(nodes.size());
    for (const GltfPlacedNode& placed : nodes)
    {
        m_nodes[placed.node] = static_cast<std::uint32_t>(m_scene.nodes.size());
        addNode(placed);
    }
}

void GltfRig::addNode(const GltfPlacedNode& placed)
{
    const tinygltf::Node& source = m_document.model.nodes[placed.node];
    Node node;
    node.parent = placed.parent;
    node.name = source.name;
    node.translation = gltfVec3(source.translation, 0.0);
    node.rotation = gltfQuaternion(source.rotation);
    node.scale = gltfVec3(source.scale, 1.0);
    if (!source.matrix.empty())
    {
        node.matrix = gltfLocalMatrix(m_document, placed.node);
    }
    if (source.mesh >= 0)
    {
        const tinygltf::Mesh& mesh = m_document.model.meshes[source.mesh];
        const std::vector<double>& weights = source.weights.empty() ? mesh.weights : source.weights;
        node.morph_weights.assign(weights.begin(), weights.end());
        const std::size_t target_count = gltfTargetCount(mesh);
        if ((!weights.empty() && weights.size() != target_count) || !allFinite(node.morph_weights))
        {
            m_warnings.add("morph weights that are not finite, or not as many as targets, taken as 0 or cut off",
                           fmt::format("nodes[{}]", placed.node));
        }
        node.morph_weights.resize(target_count);
        std::replace_if(
            node.morph_weights.begin(), node.morph_weights.end(), [](float weight) { return !std::isfinite(weight); },
            0.0F);
    }
    m_scene.nodes.push_back(std::move(node));
}

std::uint32_t GltfRig::skin(int skin)
{
    const auto [known, is_new] = m_skins.emplace(skin, kNone);
    if (is_new)
    {
        known->second = loadSkin(skin);
    }
    return known->second;
}

std::uint32_t GltfRig::loadSkin(int skin)
{
    const GltfSkinSource& source = m_document.skins[skin];
    const std::string where = fmt::format("skins[{}]", skin);
    m_document.use(where);
    Skin loaded;
    for (const int joint : source.joints)
    {
        loaded.joints.push_back(m_nodes[joint]);
    }
    if (loaded.joints.empty() || std::find(loaded.joints.begin(), loaded.joints.end(), kNone) != loaded.joints.end())
    {
        m_warnings.add("skin left out, as it has joints that are not in the scene, or none", where);
        return kNone;
    }
    loaded.inverse_bind = readInverseBind(source, where);
    if (loaded.inverse_bind.empty())
    {
        m_warnings.add("skin left out, as it does not have an affine inverse bind matrix for each joint", where);
        return kNone;
    }
    m_scene.skins.push_back(std::move(loaded));
    return static_cast<std::uint32_t>(m_scene.skins.size() - 1);
}

/// One matrix for each joint; empty if they cannot be used.
std::vector<glm::mat4> GltfRig::readInverseBind(const GltfSkinSource& source, const std::string& where)
{
    if (source.inverse_bind < 0)
    {
        return std::vector<glm::mat4>(source.joints.size(), glm::mat4(1.0F));
    }
    const GltfAccessor accessor = openAccessor(m_document, source.inverse_bind, "inverseBindMatrices of " + where);
    if (accessor.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.component_count != 16 ||
        accessor.count < source.joints.size())
    {
        return {};
    }
    const std::vector<float> numbers = readNumbers(accessor);
    std::vector<glm::mat4> matrices(source.joints.size());
    for (std::size_t i = 0; i < 16 * matrices.size(); ++i)
    {
        if (!std::isfinite(numbers[i]))
        {
            return {};
        }
        matrices[i / 16][static_cast<int>(i / 4 % 4)][static_cast<int>(i % 4)] = numbers[i];
    }
    for (glm::mat4& matrix : matrices)
    {
        if (!isAffine(glm::dmat4(matrix)))
        {
            return {};
        }
        matrix = glm::mat4(withAffineRow(glm::dmat4(matrix)));
    }
    return matrices;
}

void GltfRig::addAnimations()
{
    for (std::size_t i = 0; i < m_document.animations.size(); ++i)
    {
        const GltfAnimationSource& source = m_document.animations[i];
        Animation animation;
        animation.name = source.name;
        animation.number = static_cast<std::uint32_t>(i);
        animation.channels = readChannels(source, fmt::format("animations[{}]", i));
        for (const Channel& channel : animation.channels)
        {
            animation.seconds = std::max(animation.seconds, static_cast<double>(channel.times.back()));
        }
        if (!animation.channels.empty())
        {
            m_scene.animations.push_back(std::move(animation));
        }
    }
}

std::vector<Channel> GltfRig::readChannels(const GltfAnimationSource& source, const std::string& where)
{
    std::vector<Channel> channels;
    for (std::size_t i = 0; i < source.channels.size(); ++i)
    {
        const GltfChannelSource& channel_source = source.channels[i];
        const std::string channel_where = fmt::format("{}.channels[{}]", where, i);
        const auto leaveOut = [&](const std::string& why)
        { m_warnings.add("animation channel left out, as " + why, channel_where); };
        const std::optional<ChannelPath> path = toPath(channel_source.path);
        const std::optional<Interpolation> interpolation = toInterpolation(channel_source.interpolation);
        if (!path || !interpolation || channel_source.node < 0)
        {
            leaveOut("what it moves, or how, is not part of glTF 2.0");
            continue;
        }
        Channel channel;
        channel.node = m_nodes[channel_source.node];
        channel.path = *path;
        channel.interpolation = *interpolation;
        if (channel.node == kNone)
        {
            continue; // belongs to a scene that is not shown
        }
        const Node& node = m_scene.nodes[channel.node];
        const bool is_weights = *path == ChannelPath::Weights;
        if (is_weights ? node.morph_weights.empty() : node.matrix.has_value())
        {
            leaveOut(is_weights ? "its node has no morph targets" : "its node has a matrix");
            continue;
        }
        const std::size_t numbers = is_weights ? node.morph_weights.size() : *path == ChannelPath::Rotation ? 4 : 3;
        const std::string fault = readKeys(m_document, channel_source, numbers, channel_where, channel);
        if (!fault.empty())
        {
            leaveOut(fault);
            continue;
        }
        channels.push_back(std::move(channel));
    }
    return channels;
}

} // namespace zvo
