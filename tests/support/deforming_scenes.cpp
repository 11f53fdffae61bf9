// SPDX-License-Identifier: MIT
#include "support/deforming_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <utility>

namespace zvo::test
{

namespace
{

float uniform(std::mt19937& random, float low, float high)
{
    return std::uniform_real_distribution<float>(low, high)(random);
}

glm::vec3 vectorWithin(std::mt19937& random, float size)
{
    const float x = uniform(random, -size, size);
    const float y = uniform(random, -size, size);
    return {x, y, uniform(random, -size, size)};
}

std::vector<glm::vec3> vectors(std::mt19937& random, std::size_t count, float size)
{
    std::vector<glm::vec3> result;
    for (std::size_t i = 0; i < count; ++i)
    {
        result.push_back(vectorWithin(random, size));
    }
    return result;
}

float morphWeight(std::mt19937& random)
{
    return random() % 3 == 0 ? 0.0F : uniform(random, -1.0F, 1.5F);
}

} // namespace

Primitive deformingPrimitive(std::mt19937& random, std::size_t vertex_count, const DeformingParts& parts)
{
    Primitive primitive;
    primitive.positions = vectors(random, vertex_count, 3.0F);
    if (parts.normals)
    {
        for (std::size_t i = 0; i < vertex_count; ++i)
        {
            primitive.normals.push_back(glm::normalize(vectorWithin(random, 1.0F) + glm::vec3(0.0F, 1e-3F, 0.0F)));
        }
    }
    for (std::uint32_t i = 0; i + 2 < vertex_count; ++i)
    {
        primitive.triangles.emplace_back(i, i + 1, i + 2);
    }
    for (std::size_t i = 0; i < vertex_count && parts.joint_count != 0; ++i)
    {
        glm::vec4 weights(0.0F);
        for (int joint = 0; joint < (i % 4 == 0 ? 1 : 4); ++joint)
        {
            weights[joint] = random() % 4 == 0 ? 0.0F : uniform(random, 0.0F, 1.0F);
        }
        const float total = weights.x + weights.y + weights.z + weights.w;
        primitive.weights.push_back(total > 0.0F ? weights / total : weights);
        const auto joint = [&] { return static_cast<std::uint16_t>(random() % parts.joint_count); };
        const std::uint16_t a = joint();
        const std::uint16_t b = joint();
        const std::uint16_t c = joint();
        primitive.joints.emplace_back(a, b, c, joint());
    }
    for (std::size_t i = 0; i < parts.target_count; ++i)
    {
        MorphTarget target;
        if (i % 5 != 3)
        {
            target.positions = vectors(random, vertex_count, 0.5F);
        }
        if (parts.normals && i % 3 != 1)
        {
            target.normals = vectors(random, vertex_count, 0.5F);
        }
        primitive.morph_targets.push_back(std::move(target));
    }
    return primitive;
}

glm::mat4 randomAffine(std::mt19937& random, float distance)
{
    glm::mat4 matrix(1.0F);
    matrix = glm::translate(matrix, vectorWithin(random, distance));
    const glm::vec3 axis = vectorWithin(random, 1.0F) + glm::vec3(0.0F, 0.0F, 1e-3F);
    matrix = glm::rotate(matrix, uniform(random, -3.0F, 3.0F), glm::normalize(axis));
    const float x = uniform(random, 0.5F, 1.5F);
    const float y = uniform(random, 0.5F, 1.5F);
    const float z = uniform(random, 0.5F, 1.5F);
    matrix = glm::scale(matrix, glm::vec3(random() % 2 == 0 ? x : -x, y, z));
    matrix[0] += 0.2F * uniform(random, -1.0F, 1.0F) * matrix[1];
    return matrix;
}

void addDeforming(std::mt19937& random, Scene& scene, Pose& pose, std::uint32_t primitive, std::size_t joint_count)
{
    Instance instance;
    instance.primitive = primitive;
    if (joint_count != 0)
    {
        instance.skin = static_cast<std::uint32_t>(scene.skins.size());
        Skin skin;
        skin.joints.assign(joint_count, 0);
        skin.inverse_bind.assign(joint_count, glm::mat4(1.0F));
        scene.skins.push_back(std::move(skin));
        scene.nodes.resize(1);
    }
    scene.instances.push_back(instance);
    pose.transforms.emplace_back(1.0F);
    pose.joint_matrices.emplace_back(joint_count);
    pose.morph_weights.emplace_back(scene.primitives[primitive].morph_targets.size());
    for (glm::mat4& matrix : pose.joint_matrices.back())
    {
        matrix = randomAffine(random, 2.0F);
    }
    for (float& weight : pose.morph_weights.back())
    {
        weight = morphWeight(random);
    }
    if (joint_count == 0)
    {
        pose.transforms.back() = randomAffine(random, 2.0F);
    }
}

void changePose(std::mt19937& random, Pose& pose)
{
    for (std::size_t i = 0; i < pose.transforms.size(); ++i)
    {
        for (glm::mat4& matrix : pose.joint_matrices[i])
        {
            matrix = randomAffine(random, 2.0F);
        }
        for (float& weight : pose.morph_weights[i])
        {
            weight = morphWeight(random);
        }
        if (pose.joint_matrices[i].empty())
        {
            pose.transforms[i] = randomAffine(random, 2.0F);
        }
    }
}

} // namespace zvo::test
