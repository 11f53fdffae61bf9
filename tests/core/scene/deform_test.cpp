// SPDX-License-Identifier: MIT
// The rule of docs/deformation.md on the CPU, against values computed by hand and in double precision.
#include "core/scene/deform.h"
#include "oracle/deform.h"
#include "support/deforming_scenes.h"
#include "zvo/error.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace zvo
{
namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kNanBits = 0x7fc00000;

std::uint32_t bitsOf(float value)
{
    return std::bit_cast<std::uint32_t>(value);
}

/// A primitive of one vertex, with four joints and these weights.
Primitive oneVertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec4& weights)
{
    Primitive primitive;
    primitive.positions = {position};
    primitive.normals = {normal};
    primitive.joints = {{0, 1, 2, 3}};
    primitive.weights = {weights};
    return primitive;
}

std::vector<glm::mat4> fourJoints()
{
    std::vector<glm::mat4> joints(4, glm::mat4(1.0F));
    joints[1] = glm::translate(glm::mat4(1.0F), glm::vec3(2.0F, 0.0F, 0.0F));
    joints[2] = glm::mat4(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1); // a quarter turn: x to y
    joints[3] = glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1); // mirrored along x
    return joints;
}

glm::vec3 direction(const glm::vec3& v)
{
    return v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST(Deform, AtRestNothingChanges)
{
    std::mt19937 random(1);
    const Primitive primitive = test::deformingPrimitive(random, 100, {true, 3, 4});
    const DeformedVertices rest = deformVertices(primitive, std::vector<float>(4, 0.0F), {});
    EXPECT_EQ(rest.positions, primitive.positions);
    EXPECT_EQ(rest.normals, primitive.normals);
    EXPECT_EQ(deformVertices(primitive, {}, {}).positions, primitive.positions);
}

TEST(Deform, MorphTargetsAddInTheirOrder)
{
    Primitive primitive = oneVertex({1, 2, 3}, {0, 1, 0}, {});
    primitive.joints.clear();
    primitive.weights.clear();
    primitive.morph_targets = {{{{4, 0, -2}}, {}}, {{}, {{0, -0.5F, 1}}}, {{{1, 1, 1}}, {{1, 0, 0}}}};
    const DeformedVertices moved = deformVertices(primitive, std::vector{0.5F, 2.0F, -1.0F}, {});
    EXPECT_EQ(moved.positions[0], glm::vec3(2, 1, 1));
    EXPECT_EQ(moved.normals[0], glm::vec3(-1, 0, 2));

    // 1 is lost after 2^24 if it is added second, but not if it is added last.
    primitive.positions = {{0, 0, 0}};
    primitive.morph_targets = {{{{1.0F, 0x1p24F, 0}}, {}}, {{{0x1p24F, 1.0F, 0}}, {}}, {{{-0x1p24F, -0x1p24F, 0}}, {}}};
    const DeformedVertices ordered = deformVertices(primitive, std::vector{1.0F, 1.0F, 1.0F}, {});
    EXPECT_EQ(ordered.positions[0], glm::vec3(0, 0, 0));
    primitive.morph_targets = {{{{0x1p24F, 0, 0}}, {}}, {{{-0x1p24F, 0, 0}}, {}}, {{{1.0F, 0, 0}}, {}}};
    EXPECT_EQ(deformVertices(primitive, std::vector{1.0F, 1.0F, 1.0F}, {}).positions[0], glm::vec3(1, 0, 0));
}

TEST(Deform, MissingWeightsAreZero)
{
    Primitive primitive = oneVertex({1, 2, 3}, {0, 1, 0}, {});
    primitive.morph_targets = {{{{4, 0, -2}}, {}}, {{{kNan, 8, 8}}, {}}};
    EXPECT_EQ(deformVertices(primitive, std::vector{1.0F}, {}).positions[0], glm::vec3(5, 2, 1));
}

TEST(Deform, AVertexFollowsItsJoint)
{
    const std::vector<glm::mat4> joints = fourJoints();
    const auto on = [&](const glm::vec4& weights) {
        return deformVertices(oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, weights), {}, joints);
    };
    EXPECT_EQ(on({1, 0, 0, 0}).positions[0], glm::vec3(1, 2, 3));
    EXPECT_EQ(on({0, 1, 0, 0}).positions[0], glm::vec3(3, 2, 3));
    EXPECT_EQ(on({0, 0, 1, 0}).positions[0], glm::vec3(-2, 1, 3));
    EXPECT_EQ(on({0, 0, 1, 0}).normals[0], glm::vec3(-0.8F, 0.6F, 0));
    EXPECT_EQ(on({0.5F, 0.25F, 0, 0.25F}).positions[0], glm::vec3(1, 2, 3));
    EXPECT_EQ(on({0.25F, 0, 0.75F, 0}).positions[0], glm::vec3(-1.25F, 1.25F, 3));
}

TEST(Deform, MirroringJointsTurnNoSurfaceInsideOut)
{
    const DeformedVertices mirrored =
        deformVertices(oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, {0, 0, 0, 1}), {}, fourJoints());
    EXPECT_EQ(mirrored.positions[0], glm::vec3(-1, 2, 3));
    EXPECT_EQ(mirrored.normals[0], glm::vec3(-0.6F, 0.8F, 0));
}

TEST(Deform, WithoutANormalAMirroredVertexTurnsItsTrianglesRound)
{
    const auto on = [](const glm::vec3& normal, const glm::vec4& weights) {
        return deformVertices(oneVertex({1, 2, 3}, normal, weights), {}, fourJoints()).normals.at(0);
    };
    EXPECT_EQ(on({0, 0, 0}, {0, 0, 0, 1}), kTurnedRound);
    EXPECT_EQ(on({0, 0, 0}, {0.25F, 0, 0, 0.75F}), kTurnedRound) << "the blended matrix mirrors";
    EXPECT_EQ(on({0, 0, 0}, {0.75F, 0, 0, 0.25F}), glm::vec3(0));
    EXPECT_EQ(on({0, 0, 0}, {0, 0, 1, 0}), glm::vec3(0));
    EXPECT_EQ(on({0, 0x1.8p-100F, 0}, {0, 0, 0, 1}), kTurnedRound) << "too short for the voxelizer";
    EXPECT_NE(on({0, 0x1p-99F, 0}, {0, 0, 0, 1}), kTurnedRound);
    EXPECT_EQ(on({0, 0x1p100F, 0}, {0, 0, 0, 1}), kTurnedRound) << "too long";
    EXPECT_EQ(on({0, kNan, 0}, {0, 0, 0, 1}), kTurnedRound);
    EXPECT_EQ(on({0, kNan, 0}, {1, 0, 0, 0}), glm::vec3(0));
}

TEST(Deform, NormalsStayUprightOnWhatIsStretched)
{
    const std::vector<glm::mat4> joints(4, glm::scale(glm::mat4(1.0F), glm::vec3(4, 1, 1)));
    const DeformedVertices stretched = deformVertices(oneVertex({1, 0, 0}, {1, 1, 0}, {1, 0, 0, 0}), {}, joints);
    EXPECT_EQ(direction(stretched.normals[0]), glm::vec3(0.25F, 1, 0));
}

TEST(Deform, NormalsDoNotDependOnTheScale)
{
    for (const int exponent : {-95, -60, -20, -1, 1, 20, 60, 95})
    {
        std::vector<glm::mat4> joints = fourJoints();
        const Primitive primitive = oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, {0.5F, 0.25F, 0.125F, 0.125F});
        const glm::vec3 normal = deformVertices(primitive, {}, joints).normals[0];
        for (glm::mat4& joint : joints)
        {
            for (int column = 0; column < 3; ++column)
            {
                joint[column] *= std::ldexp(1.0F, exponent);
            }
        }
        EXPECT_EQ(deformVertices(primitive, {}, joints).normals[0], normal) << exponent;
    }
}

TEST(Deform, WithoutALinearPartThereIsNoNormal)
{
    std::vector<glm::mat4> joints(4, glm::scale(glm::mat4(1.0F), glm::vec3(0.0F)));
    const Primitive primitive = oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, {1, 0, 0, 0});
    EXPECT_EQ(deformVertices(primitive, {}, joints).normals[0], glm::vec3(0));
    joints.assign(4, glm::scale(glm::mat4(1.0F), glm::vec3(1e35F)));
    EXPECT_EQ(deformVertices(primitive, {}, joints).normals[0], glm::vec3(0));
    joints.assign(4, glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, kInfinity, 1.0F)));
    EXPECT_EQ(deformVertices(primitive, {}, joints).normals[0], glm::vec3(0));
}

TEST(Deform, AJointOfWeightZeroAddsNothing)
{
    std::vector<glm::mat4> joints = fourJoints();
    joints[1] = glm::mat4(kNan);
    Primitive primitive = oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, {0.5F, 0, 0.5F, -0.0F});
    joints[3] = glm::mat4(kInfinity);
    const DeformedVertices expected = deformVertices(primitive, {}, fourJoints());
    EXPECT_EQ(deformVertices(primitive, {}, joints).positions, expected.positions);
    EXPECT_EQ(deformVertices(primitive, {}, joints).normals, expected.normals);
    primitive.joints[0] = {0, 60000, 2, 60000}; // joints that do not exist
    EXPECT_EQ(deformVertices(primitive, {}, joints).positions, expected.positions);
}

TEST(Deform, WithoutWeightsAVertexHangsOnItsFirstJoint)
{
    Primitive primitive = oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, {0, -0.0F, 1e-38F, 1e-40F});
    primitive.joints[0] = {2, 1, 0, 3};
    EXPECT_EQ(deformVertices(primitive, {}, fourJoints()).positions[0], glm::vec3(-2, 1, 3));
}

TEST(Deform, AJointThatIsNotThereIsRefused)
{
    Primitive primitive = oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, {0.5F, 0.5F, 0, 0});
    primitive.joints[0] = {0, 4, 0, 0};
    EXPECT_THROW(deformVertices(primitive, {}, fourJoints()), Error);
}

TEST(Deform, WithoutNormalsThereAreNone)
{
    Primitive primitive = oneVertex({1, 2, 3}, {0.6F, 0.8F, 0}, {1, 0, 0, 0});
    primitive.normals.clear();
    primitive.morph_targets = {{{{1, 0, 0}}, {}}};
    EXPECT_TRUE(deformVertices(primitive, std::vector{1.0F}, {}).normals.empty());
    const DeformedVertices moved = deformVertices(primitive, std::vector{1.0F}, fourJoints());
    EXPECT_EQ(moved.positions[0], glm::vec3(2, 2, 3));
    EXPECT_EQ(moved.normals, std::vector{glm::vec3(0)}) << "on joints, 0 tells that they do not mirror";
}

TEST(Deform, WhatIsNotFiniteIsOneNan)
{
    for (const float bad : {kNan, -kNan, kInfinity, -kInfinity, std::bit_cast<float>(0xffffffffU)})
    {
        Primitive primitive = oneVertex({bad, 2, 3}, {0.6F, bad, 0}, {1, 0, 0, 0});
        primitive.morph_targets = {{{{0, 1, 1}}, {}}};
        const DeformedVertices rest = deformVertices(primitive, {}, {});
        EXPECT_EQ(bitsOf(rest.positions[0].x), kNanBits);
        EXPECT_EQ(rest.positions[0].y, 2.0F);
        EXPECT_EQ(bitsOf(rest.normals[0].y), kNanBits);
        const DeformedVertices weighed =
            deformVertices(oneVertex({1, 2, 3}, {1, 0, 0}, {bad, 0, 0, 0}), {}, fourJoints());
        EXPECT_EQ(bitsOf(weighed.positions[0].x), kNanBits);
        EXPECT_EQ(weighed.normals[0], glm::vec3(0));
    }
    // An overflow in between counts, even if later terms would make up for it.
    const std::vector<glm::mat4> huge(4, glm::scale(glm::mat4(1.0F), glm::vec3(1e30F)));
    const Primitive primitive = oneVertex({1e10F, 2, 3}, {1, 0, 0}, {1e-30F, 0, 0, 0});
    EXPECT_EQ(bitsOf(deformVertices(primitive, {}, huge).positions[0].x), kNanBits);
}

TEST(Deform, WhatIsTinyIsZero)
{
    // Values just below 2^-100 and equal to it, as an input, as a product and as a sum.
    const float below = std::nextafter(0x1p-100F, 0.0F);
    Primitive primitive = oneVertex({below, 0x1p-100F, -below}, {0, 1, 0}, {});
    primitive.morph_targets = {{{{0, 0, 0}}, {}}, {{{-0.0F, -0x1.8p-100F, 1}}, {}}};
    primitive.joints.clear();
    primitive.weights.clear();
    const DeformedVertices rest = deformVertices(primitive, {}, {});
    EXPECT_EQ(bitsOf(rest.positions[0].x), 0U);
    EXPECT_EQ(rest.positions[0].y, 0x1p-100F);
    EXPECT_EQ(bitsOf(rest.positions[0].z), 0U);
    const DeformedVertices moved = deformVertices(primitive, std::vector{0.0F, 1.0F}, {});
    EXPECT_EQ(moved.positions[0].y, -0x1p-101F) << "a difference of two that count";
    EXPECT_EQ(moved.positions[0].z, 1.0F);
    EXPECT_EQ(bitsOf(moved.positions[0].x), 0U);
    const DeformedVertices small = deformVertices(primitive, std::vector{0.0F, 0x1p-50F}, {});
    EXPECT_EQ(small.positions[0].y, 0x1p-100F) << "the product is dropped";
    EXPECT_EQ(small.positions[0].z, 0x1p-50F);
}

/// A random pose of an instance of primitive.
Pose poseOf(std::mt19937& random, const Primitive& primitive, std::size_t joint_count)
{
    Scene scene;
    scene.primitives.push_back(primitive);
    Pose pose;
    test::addDeforming(random, scene, pose, 0, joint_count);
    return pose;
}

/// Expects that vertices equal those of primitive within the bounds of single precision. Returns the number of normals
/// that had a bound.
std::size_t expectNearDoubles(const Primitive& primitive, std::span<const float> weights,
                              std::span<const glm::mat4> joints, const DeformedVertices& vertices)
{
    std::size_t normal_count = 0;
    for (std::size_t i = 0; i < primitive.positions.size(); ++i)
    {
        const oracle::DeformedVertex expected = oracle::deformVertex(primitive, i, weights, joints);
        const glm::dvec3 error = glm::abs(glm::dvec3(vertices.positions[i]) - expected.position);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(error, expected.position_bound)))
            << "vertex " << i << " is off by " << error.x << " " << error.y << " " << error.z;
        if (!primitive.normals.empty() && !std::isinf(expected.normal_bound))
        {
            const glm::dvec3 normal = glm::normalize(glm::dvec3(vertices.normals[i]));
            EXPECT_LE(glm::distance(normal, expected.normal), expected.normal_bound) << "vertex " << i;
            ++normal_count;
        }
    }
    return normal_count;
}

TEST(Deform, IsWithinRoundingsOfDoublePrecision)
{
    std::mt19937 random(2);
    for (const std::size_t joint_count : {std::size_t{0}, std::size_t{1}, std::size_t{40}})
    {
        for (const std::size_t target_count : {std::size_t{0}, std::size_t{1}, std::size_t{12}})
        {
            const Primitive primitive = test::deformingPrimitive(random, 2000, {true, joint_count, target_count});
            const Pose pose = poseOf(random, primitive, joint_count);
            const DeformedVertices vertices = deformVertices(primitive, pose.morph_weights[0], pose.joint_matrices[0]);
            EXPECT_GT(expectNearDoubles(primitive, pose.morph_weights[0], pose.joint_matrices[0], vertices), 1500U);
        }
    }
}

TEST(Deform, WithoutNormalsItTellsWhereJointsMirrorInDoublePrecision)
{
    std::mt19937 random(4);
    const Primitive primitive = test::deformingPrimitive(random, 4000, {false, 40, 2});
    const Pose pose = poseOf(random, primitive, 40);
    const DeformedVertices vertices = deformVertices(primitive, pose.morph_weights[0], pose.joint_matrices[0]);
    ASSERT_EQ(vertices.normals.size(), 4000U);
    int side_count[3] = {};
    for (std::size_t i = 0; i < vertices.normals.size(); ++i)
    {
        const int side = oracle::deformVertex(primitive, i, pose.morph_weights[0], pose.joint_matrices[0]).side;
        ++side_count[side + 1];
        if (side != 0)
        {
            EXPECT_EQ(vertices.normals[i], side < 0 ? kTurnedRound : glm::vec3(0)) << "vertex " << i;
        }
    }
    EXPECT_GT(side_count[0], 1000);
    EXPECT_LT(side_count[1], 100);
    EXPECT_GT(side_count[2], 1000);
}

TEST(Deform, TheBoundsNoticeAChangedVertex)
{
    std::mt19937 random(3);
    const Primitive primitive = test::deformingPrimitive(random, 200, {true, 5, 3});
    const Pose pose = poseOf(random, primitive, 5);
    std::size_t noticed = 0;
    for (std::size_t i = 0; i < 200; ++i)
    {
        Primitive changed = primitive;
        changed.positions[i].y *= 1.0F + 0x1p-16F;
        const oracle::DeformedVertex expected =
            oracle::deformVertex(primitive, i, pose.morph_weights[0], pose.joint_matrices[0]);
        const glm::vec3 moved = deformVertices(changed, pose.morph_weights[0], pose.joint_matrices[0]).positions[i];
        const glm::dvec3 error = glm::abs(glm::dvec3(moved) - expected.position);
        noticed += glm::any(glm::greaterThan(error, expected.position_bound)) ? 1 : 0;
    }
    EXPECT_GT(noticed, 100U);
}

} // namespace
} // namespace zvo
