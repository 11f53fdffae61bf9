// SPDX-License-Identifier: MIT
#include "support/scene_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace zvo::test
{

namespace
{

void require(bool condition, const char* what)
{
    if (!condition)
    {
        throw std::logic_error(what);
    }
}

bool isFinite(const glm::vec3& vector)
{
    return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

bool areFinite(const std::vector<float>& numbers)
{
    return std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
}

bool isAffineMatrix(const glm::mat4& matrix)
{
    bool affine = true;
    for (int column = 0; column < 4; ++column)
    {
        affine = affine && isFinite(matrix[column]) && matrix[column].w == (column == 3 ? 1.0F : 0.0F);
    }
    return affine;
}

bool isNoneOrBelow(std::uint32_t index, std::size_t count)
{
    return index == kNone || index < count;
}

void checkMaterials(const Scene& scene)
{
    for (const Image& image : scene.images)
    {
        require(image.width > 0 && image.height > 0, "an image without pixels");
        require(image.rgba.size() == std::size_t{image.width} * image.height * 4, "an image of another size");
    }
    for (const Texture& texture : scene.textures)
    {
        require(texture.image < scene.images.size(), "an image that is not there");
    }
    for (const Material& material : scene.materials)
    {
        const std::size_t texture_count = std::max<std::size_t>(scene.textures.size(), 1);
        require(material.base_color_texture.value_or(0) < texture_count &&
                    material.emission_texture.value_or(0) < texture_count,
                "a texture that is not there");
        require(glm::all(glm::greaterThanEqual(material.emission, glm::vec3(0.0F))), "emission below 0");
    }
}

void checkWeights(const Primitive& primitive)
{
    for (const glm::vec4& weights : primitive.weights)
    {
        double sum = 0.0;
        for (int i = 0; i < 4; ++i)
        {
            require(weights[i] >= 0.0F && weights[i] <= 1.0F, "a joint weight that is not from 0 to 1");
            sum += weights[i];
        }
        require(std::abs(sum - 1.0) < 1e-6, "joint weights whose sum is not 1");
    }
}

void checkPrimitive(const Scene& scene, const Primitive& primitive)
{
    const std::size_t vertex_count = primitive.positions.size();
    const auto fits = [&](std::size_t count) { return count == 0 || count == vertex_count; };
    require(fits(primitive.normals.size()) && fits(primitive.uvs.size()) && fits(primitive.emission_uvs.size()) &&
                fits(primitive.colors.size()) && fits(primitive.joints.size()) &&
                primitive.joints.size() == primitive.weights.size(),
            "vertex arrays of different lengths");
    require(primitive.material < scene.materials.size(), "a material that is not there");
    for (const glm::uvec3& triangle : primitive.triangles)
    {
        require(std::max({triangle.x, triangle.y, triangle.z}) < vertex_count, "a vertex that is not there");
    }
    for (const glm::vec3& normal : primitive.normals)
    {
        const float length = glm::length(normal);
        require(length == 0.0F || std::abs(length - 1.0F) < 1e-5F, "a normal that is not of unit length");
    }
    checkWeights(primitive);
    for (const MorphTarget& target : primitive.morph_targets)
    {
        require(fits(target.positions.size()) && fits(target.normals.size()) &&
                    (target.normals.empty() || !primitive.normals.empty()),
                "a morph target of another length");
        require(std::all_of(target.positions.begin(), target.positions.end(), isFinite) &&
                    std::all_of(target.normals.begin(), target.normals.end(), isFinite),
                "a morph target that is not finite");
    }
}

void checkInstance(const Scene& scene, const Instance& instance)
{
    require(instance.primitive < scene.primitives.size(), "a primitive that is not there");
    require(isAffineMatrix(instance.transform), "a transform that is not affine or not finite");
    require(isNoneOrBelow(instance.node, scene.nodes.size()), "a node that is not there");
    require(isNoneOrBelow(instance.skin, scene.skins.size()), "a skin that is not there");
    if (instance.skin != kNone)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        require(!primitive.joints.empty(), "a skin on a mesh without joints");
        const std::size_t joint_count = scene.skins[instance.skin].joints.size();
        for (const glm::u16vec4& joints : primitive.joints)
        {
            require(std::max({joints.x, joints.y, joints.z, joints.w}) < joint_count, "a joint that is not there");
        }
    }
}

void checkNodes(const Scene& scene)
{
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    {
        const Node& node = scene.nodes[i];
        require(isNoneOrBelow(node.parent, i), "a node that stands before its parent");
        require(areFinite(node.morph_weights), "a morph weight that is not finite");
    }
    for (const Skin& skin : scene.skins)
    {
        require(!skin.joints.empty() && skin.joints.size() == skin.inverse_bind.size(),
                "a skin without joints, or without a matrix for each");
        for (const std::uint32_t joint : skin.joints)
        {
            require(joint < scene.nodes.size(), "a joint that is no node");
        }
        require(std::all_of(skin.inverse_bind.begin(), skin.inverse_bind.end(), isAffineMatrix),
                "an inverse bind matrix that is not affine or not finite");
    }
}

void checkChannel(const Scene& scene, const Channel& channel)
{
    require(channel.node < scene.nodes.size(), "a channel that moves no node");
    const Node& node = scene.nodes[channel.node];
    require(channel.path == ChannelPath::Weights || !node.matrix, "a channel that moves a node with a matrix");
    require(!channel.times.empty() && areFinite(channel.times) && channel.times.front() >= 0.0F &&
                std::is_sorted(channel.times.begin(), channel.times.end()),
            "times out of order");
    const std::size_t numbers = channel.path == ChannelPath::Weights    ? node.morph_weights.size()
                                : channel.path == ChannelPath::Rotation ? 4
                                                                        : 3;
    const std::size_t tangents = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
    require(numbers > 0 && channel.values.size() == channel.times.size() * numbers * tangents,
            "a channel without a value for each time");
    require(areFinite(channel.values), "a value that is not finite");
}

void checkAnimations(const Scene& scene)
{
    for (const Animation& animation : scene.animations)
    {
        double last = 0.0;
        for (const Channel& channel : animation.channels)
        {
            checkChannel(scene, channel);
            last = std::max(last, static_cast<double>(channel.times.back()));
        }
        require(animation.seconds == last, "an animation that does not end with its last key");
    }
}

} // namespace

std::string sceneFault(const Scene& scene)
{
    try
    {
        checkMaterials(scene);
        for (const Primitive& primitive : scene.primitives)
        {
            checkPrimitive(scene, primitive);
        }
        checkNodes(scene);
        for (const Instance& instance : scene.instances)
        {
            checkInstance(scene, instance);
        }
        checkAnimations(scene);
    }
    catch (const std::logic_error& fault)
    {
        return fault.what();
    }
    return "";
}

} // namespace zvo::test
