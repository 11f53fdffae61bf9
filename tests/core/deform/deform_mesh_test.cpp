// SPDX-License-Identifier: MIT
// The device deforms vertices to the same bits as deformVertices().
#include "core/deform/deform_mesh.h"

#include "core/base/kernels.h"
#include "core/scene/animation.h"
#include "core/scene/deform.h"
#include "support/deforming_scenes.h"
#include "support/device.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace zvo
{
namespace
{

using test::device;

/// Deformed vertices of all instances, and the names of the passes.
struct Deformed
{
    std::vector<gpu::vec3> positions;
    std::vector<gpu::vec3> normals;
    std::vector<std::string> passes;
};

/// Deforms repeatedly on a device, always into the same buffers.
class Deformer
{
public:
    Deformer(vk::HeadlessDevice& device, const Scene& scene)
        : m_device(device), m_mesh(uploadDeformMesh(device, scene)), m_pose(device.device(), m_mesh),
          m_positions(device.device(), "out_positions", m_mesh.position_count),
          m_normals(device.device(), "out_normals", m_mesh.normal_count)
    {
    }

    Deformed run(const Pose& pose)
    {
        Deformed result;
        const std::vector<vk::PassTime> passes = m_device.run(
            [&](vk::FrameGraph& graph)
            {
                updatePose(graph, m_mesh, pose, m_pose);
                deform(graph, m_mesh, m_pose, m_positions, m_normals);
            });
        for (const vk::PassTime& pass : passes)
        {
            result.passes.push_back(pass.name);
        }
        result.positions = m_device.download(m_positions);
        result.normals = m_device.download(m_normals);
        return result;
    }

    [[nodiscard]] const DeformMesh& mesh() const { return m_mesh; }

private:
    vk::HeadlessDevice& m_device;
    DeformMesh m_mesh;
    PoseBuffers m_pose;
    vk::BufferOf<gpu::vec3> m_positions;
    vk::BufferOf<gpu::vec3> m_normals;
};

// Index of the first component with different bits.
std::optional<std::size_t> firstDifference(std::span<const gpu::vec3> seen, std::span<const glm::vec3> expected)
{
    for (std::size_t i = 0; i < 3 * expected.size(); ++i)
    {
        const auto component = static_cast<int>(i % 3);
        if (std::bit_cast<std::uint32_t>(seen[i / 3][component]) !=
            std::bit_cast<std::uint32_t>(expected[i / 3][component]))
        {
            return i;
        }
    }
    return std::nullopt;
}

void expectEqualsTheRule(const Scene& scene, const Pose& pose, const DeformMesh& mesh, const Deformed& seen)
{
    for (const DeformMesh::Part& part : mesh.parts)
    {
        const Primitive& primitive = scene.primitives[scene.instances[part.instance].primitive];
        const DeformedVertices expected =
            deformVertices(primitive, pose.morph_weights[part.instance], pose.joint_matrices[part.instance]);
        const auto [first_position, first_normal] = mesh.offsets[part.instance];
        ASSERT_LE(first_position + expected.positions.size(), seen.positions.size());
        EXPECT_EQ(firstDifference(std::span(seen.positions).subspan(first_position), expected.positions), std::nullopt)
            << "positions of instance " << part.instance;
        ASSERT_EQ(first_normal == gpu::kAbsent, expected.normals.empty());
        if (!expected.normals.empty())
        {
            ASSERT_LE(first_normal + expected.normals.size(), seen.normals.size());
            EXPECT_EQ(firstDifference(std::span(seen.normals).subspan(first_normal), expected.normals), std::nullopt)
                << "normals of instance " << part.instance;
        }
    }
}

// Deforms a scene in a pose on the device, and expects that it equals the rule.
Deformed expectEqualsTheRule(const Scene& scene, const Pose& pose)
{
    Deformer deformer(device(), scene);
    Deformed seen = deformer.run(pose);
    expectEqualsTheRule(scene, pose, deformer.mesh(), seen);
    return seen;
}

/// A scene of one instance, and its pose.
std::pair<Scene, Pose> oneInstance(std::mt19937& random, std::size_t vertex_count, const test::DeformingParts& parts)
{
    std::pair<Scene, Pose> result;
    result.first.primitives.push_back(test::deformingPrimitive(random, vertex_count, parts));
    test::addDeforming(random, result.first, result.second, 0, parts.joint_count);
    return result;
}

TEST(DeformMesh, EveryVariantOfEverySizeEqualsTheRule)
{
    std::mt19937 random(5);
    for (const std::size_t vertex_count : {0, 1, 27, 64, 65, 2049})
    {
        for (const bool normals : {false, true})
        {
            for (const test::DeformingParts& parts :
                 {test::DeformingParts{normals, 0, 4}, test::DeformingParts{normals, 7, 0},
                  test::DeformingParts{normals, 7, 4}})
            {
                const auto [scene, pose] = oneInstance(random, vertex_count, parts);
                SCOPED_TRACE(vertex_count);
                const Deformed seen = expectEqualsTheRule(scene, pose);
                EXPECT_EQ(seen.positions.size(), vertex_count);
                EXPECT_EQ(seen.normals.size(), normals || parts.joint_count != 0 ? vertex_count : 0);
            }
        }
    }
}

TEST(DeformMesh, BigMeshesEqualTheRule)
{
    std::mt19937 random(6);
    const auto [scene, pose] = oneInstance(random, 231917, {true, 300, 3});
    expectEqualsTheRule(scene, pose);
}

TEST(DeformMesh, ManyTargetsEqualTheRule)
{
    std::mt19937 random(7);
    auto [scene, pose] = oneInstance(random, 70, {true, 2, 2000});
    expectEqualsTheRule(scene, pose);
    pose.morph_weights[0].assign(2000, 0.001F); // none of them is 0
    expectEqualsTheRule(scene, pose);
}

TEST(DeformMesh, InstancesOfOneMeshDeformEachInItsWay)
{
    std::mt19937 random(8);
    Scene scene;
    Pose pose;
    scene.primitives.push_back(test::deformingPrimitive(random, 100, {true, 5, 3}));
    scene.primitives.push_back(test::deformingPrimitive(random, 40, {true, 0, 0})); // rigid
    scene.primitives.push_back(test::deformingPrimitive(random, 64, {false, 9, 0}));
    scene.primitives.push_back(test::deformingPrimitive(random, 130, {true, 5, 0}));
    for (const auto& [primitive, joint_count] : std::vector<std::pair<std::uint32_t, std::size_t>>{
             {0, 5}, {1, 0}, {2, 9}, {0, 6}, {3, 5}, {2, 20}, {0, 0}, {3, 0}, {1, 0}, {3, 5}})
    {
        test::addDeforming(random, scene, pose, primitive, joint_count);
    }
    Deformer deformer(device(), scene);
    const DeformMesh& mesh = deformer.mesh();
    EXPECT_EQ(mesh.parts.size(), 7U); // the primitive with joints but no skin is rigid
    EXPECT_EQ(mesh.positions.count(), 100U + 64U + 130U) << "what is at rest is there once";
    EXPECT_EQ(mesh.position_count, 3U * 100 + 40 + 2 * 64 + 2 * 130 + 130);
    EXPECT_EQ(mesh.offsets[1].first_position, mesh.offsets[8].first_position);
    for (int round = 0; round < 4; ++round)
    {
        expectEqualsTheRule(scene, pose, mesh, deformer.run(pose));
        test::changePose(random, pose);
    }
}

TEST(DeformMesh, EachVariantIsOnePassHoweverManyInstances)
{
    std::mt19937 random(9);
    Scene scene;
    Pose pose;
    scene.primitives.push_back(test::deformingPrimitive(random, 10, {true, 5, 3}));
    scene.primitives.push_back(test::deformingPrimitive(random, 10, {true, 5, 0}));
    for (int i = 0; i < 300; ++i)
    {
        test::addDeforming(random, scene, pose, static_cast<std::uint32_t>(i % 2), 5);
    }
    const Deformed seen = expectEqualsTheRule(scene, pose);
    EXPECT_EQ(std::count(seen.passes.begin(), seen.passes.end(), "deform/vertices"), 2);
}

/// Floats of every kind: NaN of several sorts, infinite, huge, tiny, subnormal, zeros of both signs, and ordinary.
class OddFloats
{
public:
    explicit OddFloats(std::uint32_t seed, std::uint32_t odd_in) : m_random(seed), m_odd_in(odd_in) {}

    float next()
    {
        const float ordinary = std::uniform_real_distribution<float>(-2.0F, 2.0F)(m_random);
        if (m_random() % m_odd_in != 0)
        {
            return ordinary;
        }
        const auto fraction = static_cast<std::uint32_t>(m_random() % 0x7fffffU);
        switch (m_random() % 12)
        {
        case 0:
            return std::bit_cast<float>(0x7f800001U + fraction); // NaN
        case 1:
            return std::bit_cast<float>(0xff800001U + fraction);
        case 2:
            return ordinary * std::numeric_limits<float>::infinity();
        case 3:
            return std::bit_cast<float>(1 + fraction); // subnormal
        case 4:
            return -std::bit_cast<float>(1 + fraction);
        case 5:
            return 0.0F;
        case 6:
            return -0.0F;
        case 7:
            return ordinary * std::numeric_limits<float>::min();
        case 8:
            return ordinary * 0x1p-100F;
        case 9:
            return ordinary * 0x1p-50F;
        case 10:
            return ordinary * 0x1p60F;
        default:
            return ordinary * 0x1p126F;
        }
    }

    glm::vec3 nextVector()
    {
        const float x = next();
        const float y = next();
        return {x, y, next()};
    }

private:
    std::mt19937 m_random;
    std::uint32_t m_odd_in;
};

TEST(DeformMesh, OddNumbersEqualTheRule)
{
    std::mt19937 random(10);
    for (const std::uint32_t odd_in : {1U, 2U, 10U, 100U})
    {
        OddFloats floats(odd_in, odd_in);
        auto [scene, pose] = oneInstance(random, 20000, {true, 50, 3});
        Primitive& primitive = scene.primitives[0];
        for (std::size_t i = 0; i < primitive.positions.size(); ++i)
        {
            primitive.positions[i] = floats.nextVector();
            primitive.normals[i] = floats.nextVector();
            primitive.weights[i] = glm::vec4(floats.nextVector(), floats.next());
            for (MorphTarget& target : primitive.morph_targets)
            {
                if (!target.positions.empty())
                {
                    target.positions[i] = floats.nextVector();
                }
                if (!target.normals.empty())
                {
                    target.normals[i] = floats.nextVector();
                }
            }
        }
        for (glm::mat4& joint : pose.joint_matrices[0])
        {
            for (int column = 0; column < 4; ++column)
            {
                joint[column] = glm::vec4(floats.nextVector(), floats.next());
            }
        }
        pose.morph_weights[0] = {floats.next(), floats.next(), floats.next()};
        SCOPED_TRACE(odd_in);
        const Deformed seen = expectEqualsTheRule(scene, pose);
        std::size_t finite = 0;
        for (const gpu::vec3& position : seen.positions)
        {
            finite += std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z) ? 1 : 0;
        }
        if (odd_in >= 10)
        {
            EXPECT_GT(finite, 1000U);
        }
        EXPECT_LT(finite, 20000U);
    }
}

TEST(DeformMesh, NumbersAroundTheSmallestThatCountEqualTheRule)
{
    std::mt19937 random(17);
    const auto factor = [&](int exponent)
    { return std::ldexp(std::uniform_real_distribution<float>(0.5F, 2.0F)(random), exponent); };
    // Inputs, products of targets, and products of joints, with values on both sides of 2^-100.
    auto [scene, pose] = oneInstance(random, 4096, {false, 1, 2});
    Primitive& primitive = scene.primitives[0];
    for (MorphTarget& target : primitive.morph_targets)
    {
        target.positions.resize(primitive.positions.size());
    }
    for (std::size_t i = 0; i < primitive.positions.size(); ++i)
    {
        primitive.positions[i] = glm::vec3(factor(-100), 0.0F, -factor(-100));
        primitive.morph_targets[0].positions[i] = glm::vec3(0.0F, factor(-60), 0.0F);
        primitive.morph_targets[1].positions[i] = glm::vec3(-factor(-99), factor(-100), factor(-100));
        primitive.weights[i] = glm::vec4(1.0F, 0.0F, 0.0F, 0.0F);
    }
    std::size_t zero_count = 0;
    for (const float scale : {1.0F, 1.4F, 0.7F})
    {
        pose.morph_weights[0] = {scale * 0x1p-40F, 1.0F};
        pose.joint_matrices[0][0] = glm::mat4(scale);
        const Deformed seen = expectEqualsTheRule(scene, pose);
        for (const gpu::vec3& position : seen.positions)
        {
            zero_count += position.x == 0.0F ? 1 : 0;
        }
    }
    EXPECT_GT(zero_count, 1000U);
    EXPECT_LT(zero_count, 3U * 4096 - 1000);
}

TEST(DeformMesh, NormalsOfFlatAndOfExtremeMatricesEqualTheRule)
{
    std::mt19937 random(18);
    constexpr std::size_t kVertices = 2000;
    auto [scene, pose] = oneInstance(random, kVertices, {true, 2 * kVertices, 0});
    std::vector<glm::mat4>& joints = pose.joint_matrices[0];
    for (std::size_t i = 0; i < kVertices; ++i)
    {
        scene.primitives[0].joints[i] = {i, kVertices + i, 0, 0};
        scene.primitives[0].weights[i] = {1.0F, i % 4 == 3 ? 1.0F : 0.0F, 0.0F, 0.0F};
        if (i % 2 == 0) // the columns lie in a plane up to rounding, which decides the determinant's sign
        {
            joints[i][2] = joints[i][0] * 0.7F + joints[i][1] * 1.3F;
            continue;
        }
        // The largest entry lies near the ends of the usable range; for every fourth vertex it is a difference.
        const int exponent = (i / 4 % 2 == 0 ? -100 : 100) + static_cast<int>(i % 5) - 2;
        for (int column = 0; column < 3; ++column)
        {
            joints[i][column] *= std::ldexp(1.0F, exponent + (i % 4 == 3 ? 2 : 0));
        }
        joints[kVertices + i] = joints[i] * -0.75F;
    }
    const Deformed seen = expectEqualsTheRule(scene, pose);
    std::size_t none_count = 0;
    for (std::size_t i = 1; i < kVertices; i += 2)
    {
        none_count += seen.normals[i] == gpu::vec3(0.0F) ? 1 : 0;
    }
    EXPECT_GT(none_count, 200U);
    EXPECT_LT(none_count, 800U);
}

TEST(DeformMesh, SplitOverSubmissionsItGivesTheSameBits)
{
    std::mt19937 random(11);
    const auto [scene, pose] = oneInstance(random, 3000, {true, 8, 3});
    vk::HeadlessOptions options = test::deviceOptions();
    options.slices.most_units = 3;
    vk::HeadlessDevice sliced(options, zvoKernels());
    Deformer deformer(sliced, scene);
    expectEqualsTheRule(scene, pose, deformer.mesh(), deformer.run(pose));
    EXPECT_GT(sliced.submissionCount(), 10U);
}

TEST(DeformMesh, WithoutDeformingInstancesItIsEmpty)
{
    std::mt19937 random(12);
    Scene scene;
    Pose pose;
    scene.primitives.push_back(test::deformingPrimitive(random, 30, {true, 5, 0}));
    scene.primitives.push_back(test::deformingPrimitive(random, 30, {true, 0, 2})); // no instance has it
    test::addDeforming(random, scene, pose, 0, 0);
    const std::uint64_t used = device().device().memory().usedBytes();
    const DeformMesh mesh = uploadDeformMesh(device(), scene);
    EXPECT_TRUE(mesh.empty());
    EXPECT_EQ(device().device().memory().usedBytes(), used);
    EXPECT_TRUE(uploadDeformMesh(device(), Scene{}).empty());
}

TEST(DeformMesh, PosesOfOtherScenesAreRefused)
{
    std::mt19937 random(13);
    const auto [scene, pose] = oneInstance(random, 30, {true, 5, 2});
    Deformer deformer(device(), scene);
    Pose other = pose;
    other.joint_matrices[0].pop_back();
    EXPECT_THROW(deformer.run(other), Error);
    other = pose;
    other.morph_weights[0].push_back(1.0F);
    EXPECT_THROW(deformer.run(other), Error);
    EXPECT_THROW(deformer.run({}), Error);
    expectEqualsTheRule(scene, pose, deformer.mesh(), deformer.run(pose));
}

TEST(DeformMesh, WhatNoDeviceCanFollowIsRefused)
{
    std::mt19937 random(14);
    auto [scene, pose] = oneInstance(random, 30, {true, 5, 0});
    scene.primitives[0].joints[7] = {0, 5, 0, 0};
    scene.primitives[0].weights[7] = {0.5F, 0.5F, 0.0F, 0.0F};
    EXPECT_THROW(uploadDeformMesh(device(), scene), Error);
    scene.skins[0].joints.push_back(0);
    EXPECT_EQ(uploadDeformMesh(device(), scene).joint_count, 6U);
    // A second instance uses a skin with fewer joints.
    test::addDeforming(random, scene, pose, 0, 2);
    EXPECT_THROW(uploadDeformMesh(device(), scene), Error);

    const auto [many, many_pose] = oneInstance(random, 1, {false, 0, gpu::kMorphTargetsMax + 1});
    EXPECT_THROW(uploadDeformMesh(device(), many), Error);
}

TEST(DeformMesh, MostTargetsOfAMeshStillFitAnInvocation)
{
    std::mt19937 random(15);
    auto [scene, pose] = oneInstance(random, 3, {true, 0, gpu::kMorphTargetsMax});
    pose.morph_weights[0].assign(gpu::kMorphTargetsMax, 0x1p-8F);
    expectEqualsTheRule(scene, pose);
}

TEST(DeformMesh, NeedsAreNamedBeforeMemoryIsTaken)
{
    std::mt19937 random(16);
    const auto [scene, pose] = oneInstance(random, 100000, {true, 5, 2});
    vk::HeadlessOptions options = test::deviceOptions();
    options.memory_budget_bytes = 4 << 20;
    vk::HeadlessDevice limited(options, zvoKernels());
    const std::uint64_t used = limited.device().memory().usedBytes();
    const Scene& deforming = scene; // clang 14 captures no structured binding
    const std::string message =
        test::messageOf([&] { const DeformMesh mesh = uploadDeformMesh(limited, deforming); }, ErrorCode::Memory);
    EXPECT_TRUE(message.starts_with("what deforms in the scene needs")) << message;
    // 24 bytes of a vertex at rest, 24 of a binding, 12 for each target's positions and 12 for the first's normals.
    EXPECT_GE(test::bytesNeeded(message), 100000U * (24 + 24 + 24 + 12));
    EXPECT_EQ(limited.device().memory().usedBytes(), used);
}

} // namespace
} // namespace zvo
