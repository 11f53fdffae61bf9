// SPDX-License-Identifier: MIT
// Poses against values that were computed by hand. animation_curves_test.cpp tests interpolation between keys.
#include "core/scene/animation.h"

#include "animation_scenes.h"
#include "core/scene/scene_size.h"
#include "io/gltf/gltf_builder.h"
#include "io/gltf/rig_documents.h"
#include "support/errors.h"
#include "support/scenes.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

namespace zvo::test
{

namespace
{

TEST(Animation, NodesFollowTheirParents)
{
    // A quarter turn of the root moves the child from x to y, and the leaf with it.
    Scene scene = movedBy({.path = ChannelPath::Rotation,
                           .interpolation = Interpolation::Step,
                           .times = {0, 1, 2},
                           .values = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1}});
    scene.nodes.resize(4);
    scene.nodes[0].translation = {1, 2, 3};
    scene.nodes[1].parent = 0;
    scene.nodes[1].translation = {10, 0, 0};
    scene.nodes[1].scale = {2, 2, 2};
    scene.nodes[2].parent = 1;
    scene.nodes[2].matrix = glm::mat4(1.0F);
    scene.nodes[2].matrix->operator[](3) = glm::vec4(0, 0, 5, 1);
    scene.instances = {{0, glm::mat4(1.0F), 0}, {0, glm::mat4(1.0F), 2}, {0, glm::mat4(2.0F), 3}};
    const Pose pose = poseAt(scene, 1.0);
    expectNear(pose.transforms.at(0), glm::mat4(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1), 1e-6F);
    expectNear(pose.transforms.at(1), glm::mat4(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 1, 12, 13, 1), 1e-6F);
    EXPECT_EQ(pose.transforms.at(2), glm::mat4(2.0F)); // nothing moves node 3
    EXPECT_TRUE(pose.joint_matrices.at(1).empty());
    EXPECT_TRUE(pose.morph_weights.at(1).empty());
}

TEST(Animation, WhatNothingMovesKeepsItsTransformBitForBit)
{
    Scene scene = movedBy({.path = ChannelPath::Translation, .times = {0}, .values = {0, 0, 0}});
    scene.nodes.emplace_back().translation = {0.1F, 0.2F, 0.3F};
    scene.instances.push_back({0, glm::mat4(0.1F, -0.0F, 1e-40F, 0, 7, 1e30F, 0, 0, 0, 0, 0, 0, -0.0F, 0, 0, 1), 1});
    scene.instances.push_back({0, glm::mat4(3.0F)}); // without a node
    const Pose pose = poseAt(scene, 1.0);
    for (const std::size_t i : {1U, 2U})
    {
        EXPECT_EQ(std::memcmp(&pose.transforms.at(i), &scene.instances[i].transform, sizeof(glm::mat4)), 0);
    }
}

TEST(Animation, LongChainsOfNodesNeedNoStack)
{
    constexpr std::size_t kNodes = 200000;
    Scene scene = movedBy({.path = ChannelPath::Translation, .times = {0}, .values = {3, 0, 0}});
    scene.nodes.resize(kNodes);
    for (std::uint32_t i = 1; i < kNodes; ++i)
    {
        scene.nodes[i].parent = i - 1;
        scene.nodes[i].translation = {0, 1, 0};
    }
    scene.instances[0].node = kNodes - 1;
    EXPECT_EQ(transformAt(scene, 0)[3], glm::vec4(3, kNodes - 1, 0, 1));
    EXPECT_TRUE(isAnimated(scene, 0));
}

TEST(Animation, SkinnedMeshesFollowTheirJointsAlone)
{
    const Scene scene = armDocument().load();
    const Pose rest = poseAt(scene, 0);
    EXPECT_EQ(rest.transforms.at(0), glm::mat4(1.0F)); // not that of the node
    ASSERT_EQ(rest.joint_matrices.at(0).size(), 2U);
    EXPECT_EQ(rest.joint_matrices[0][0], glm::mat4(1.0F));
    EXPECT_EQ(rest.joint_matrices[0][1], glm::mat4(1.0F));
    const Pose bent = poseAt(scene, 1);
    EXPECT_EQ(bent.joint_matrices.at(0).at(0), glm::mat4(1.0F));
    // Around (0, 1): (x, y) becomes (1 - y, 1 + x).
    expectNear(bent.joint_matrices[0].at(1), glm::mat4(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1), 1e-6F);
}

TEST(Animation, ScenesAreTurnedToTheirPlaceInTheWorld)
{
    glm::dmat4 place(2.0); // twice as large
    place[3] = glm::dvec4(10, 20, 30, 1);
    const Scene scene = armDocument().load();
    const Pose pose = poseAt(scene, 0, place);
    EXPECT_EQ(pose.transforms.at(0), glm::mat4(1.0F));
    EXPECT_EQ(pose.joint_matrices.at(0).at(1), glm::mat4(place));
    const Scene still = triangleDocument().load();
    EXPECT_EQ(poseAt(still, 0, place).transforms.at(0), glm::mat4(place));
    const Scene moved = movedBy({.path = ChannelPath::Translation, .times = {0}, .values = {1, 1, 1}});
    EXPECT_EQ(poseAt(moved, 0, place).transforms.at(0)[3], glm::vec4(12, 22, 32, 1));
}

TEST(Animation, TransformsThatOverflowAreNotFiniteButAffine)
{
    constexpr float kInfinite = std::numeric_limits<float>::infinity(); // stands for 1e300 in a file
    for (const auto& [node_count, scale] : {std::pair(2U, 3e38F), std::pair(20U, 3e38F), std::pair(2U, kInfinite)})
    {
        Scene scene = movedBy({.path = ChannelPath::Scale, .times = {0}, .values = {3e38F, 1, 1}});
        scene.nodes.resize(node_count);
        for (std::uint32_t i = 1; i < node_count; ++i)
        {
            scene.nodes[i].parent = i - 1;
            scene.nodes[i].scale = {scale, 1, 1};
        }
        scene.instances.push_back({0, glm::mat4(1.0F), kNone, 0}); // with the last node as joint
        scene.instances[0].node = node_count - 1;
        scene.skins.push_back({{node_count - 1}, {glm::mat4(1.0F)}});
        const Pose pose = poseAt(scene, 0);
        for (const glm::mat4& transform : {pose.transforms.at(0), pose.joint_matrices.at(1).at(0)})
        {
            EXPECT_FALSE(std::isfinite(transform[0].x));
            for (int column = 0; column < 4; ++column)
            {
                EXPECT_EQ(transform[column].w, column == 3 ? 1.0F : 0.0F);
            }
        }
    }
}

TEST(Animation, AnimatedIsWhatAChannelReaches)
{
    Scene scene = movedBy({.node = 1, .path = ChannelPath::Rotation, .times = {0}, .values = {0, 0, 0, 1}});
    scene.nodes.resize(6); // 0 - 1 - 2, 3 - 4, 5
    scene.nodes[1].parent = 0;
    scene.nodes[2].parent = 1;
    scene.nodes[4].parent = 3;
    scene.nodes[5].morph_weights = {0};
    scene.nodes[4].morph_weights = {0};
    scene.animations.push_back({"", {{.node = 5, .path = ChannelPath::Weights, .times = {0}, .values = {1}}}, 0.0});
    scene.primitives.push_back(scene.primitives[0]); // 1: has joints
    scene.primitives[1].joints.assign(3, glm::u16vec4(0));
    scene.primitives[1].weights.assign(3, glm::vec4(1, 0, 0, 0));
    scene.primitives.push_back(scene.primitives[0]); // 2: has a morph target
    scene.primitives[2].morph_targets.resize(1);
    scene.skins = {{{3, 2}, {glm::mat4(1.0F), glm::mat4(1.0F)}}, {{3, 4}, {glm::mat4(1.0F), glm::mat4(1.0F)}}};
    struct Case
    {
        Instance instance;
        bool animated;
    };
    const glm::mat4 any(1.0F);
    const std::vector<Case> cases = {
        {{0, any, 0}, false}, // a node above the one that moves
        {{0, any, 1}, true},      {{0, any, 2}, true},    {{0, any, 3}, false},
        {{0, any, kNone}, false}, {{1, any, 4, 0}, true}, // a joint is below node 1
        {{1, any, 4, 1}, false},  {{1, any, 2, 1}, true}, // its node moves, which a skinned mesh does not follow
        {{2, any, 5}, true},                              // its weights change
        {{2, any, 4}, false},                             // nothing changes its weights
        {{0, any, 5}, false},                             // it has no targets
    };
    scene.instances.clear();
    for (const Case& item : cases)
    {
        scene.instances.push_back(item.instance);
    }
    const std::vector<bool> animated = animatedInstances(scene);
    ASSERT_EQ(animated.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
    {
        EXPECT_EQ(isAnimated(scene, i), cases[i].animated) << i;
        EXPECT_EQ(animated[i], cases[i].animated) << i;
    }
}

TEST(Animation, PosedMeshesAreWhereTheirJointsTakeThem)
{
    const Scene scene = armDocument().load();
    const Scene posed = posedScene(scene, poseAt(scene, 1));
    EXPECT_EQ(sceneFault(posed), "");
    ASSERT_EQ(posed.instances.size(), 1U);
    EXPECT_EQ(posed.instances[0].transform, glm::mat4(1.0F));
    const std::vector<glm::vec3>& positions = posed.primitives.at(posed.instances[0].primitive).positions;
    // The third vertex rotates with the elbow; the last one is at a quarter of its path.
    const std::vector<glm::vec3> wanted = {{0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {0.75F, 1.25F, 0}};
    ASSERT_EQ(positions.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
    {
        EXPECT_LT(glm::distance(positions[i], wanted[i]), 1e-6F) << i;
    }
    EXPECT_EQ(posed.primitives[0].triangles, scene.primitives[0].triangles);
    EXPECT_TRUE(posed.nodes.empty());
    EXPECT_TRUE(posed.skins.empty());
    EXPECT_TRUE(posed.animations.empty());
}

TEST(Animation, PosedMeshesAreMorphed)
{
    GltfBuilder builder = morphDocument({0.5F, 2});
    builder.document["nodes"][0]["translation"] = {7, 0, 0};
    builder.add("nodes", {{"mesh", 0}, {"weights", {0, 0}}});
    const Scene scene = builder.load();
    const Scene posed = posedScene(scene, poseAt(scene, 0));
    ASSERT_EQ(posed.instances.size(), 2U);
    EXPECT_EQ(posed.instances[0].transform[3], glm::vec4(7, 0, 0, 1)); // the morph comes before the transform
    const Primitive& morphed = posed.primitives.at(posed.instances[0].primitive);
    EXPECT_EQ(morphed.positions, (std::vector<glm::vec3>{{0, 0, 0.5F}, {5, 0, 0.5F}, {0, 1, 0.5F}}));
    for (const glm::vec3& normal : morphed.normals)
    {
        const glm::vec3 wanted = glm::normalize(glm::vec3(0.5F, 0, 1));
        EXPECT_LT(glm::distance(glm::normalize(normal), wanted), 1e-6F);
    }
    EXPECT_TRUE(morphed.morph_targets.empty());
    const Primitive& still = posed.primitives.at(posed.instances[1].primitive);
    EXPECT_EQ(still.positions, scene.primitives[0].positions);
}

TEST(Animation, PosedScenesShareWhatDoesNotDeform)
{
    Scene scene = movedBy({.path = ChannelPath::Translation, .times = {0}, .values = {1, 2, 3}});
    scene.primitives[0].joints.assign(3, glm::u16vec4(0)); // without a skin they have no effect
    scene.primitives[0].weights.assign(3, glm::vec4(1, 0, 0, 0));
    scene.instances.push_back(scene.instances[0]);
    scene.cameras.emplace_back();
    scene.warnings.emplace_back("warning");
    const Scene posed = posedScene(scene, poseAt(scene, 0));
    ASSERT_EQ(posed.primitives.size(), 1U);
    EXPECT_EQ(posed.primitives[0].positions, scene.primitives[0].positions);
    EXPECT_TRUE(posed.primitives[0].joints.empty());
    ASSERT_EQ(posed.instances.size(), 2U);
    EXPECT_EQ(posed.instances[1].primitive, 0U);
    EXPECT_EQ(posed.instances[1].transform[3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(posed.materials.size(), scene.materials.size());
    EXPECT_EQ(posed.cameras.size(), 1U);
    EXPECT_EQ(posed.warnings.size(), 1U);
    EXPECT_EQ(posed.triangleCount(), scene.triangleCount());
}

TEST(Animation, CopiesOfDeformedMeshesAreBounded)
{
    Scene scene;
    Primitive primitive;
    constexpr std::size_t kVertices = 1 << 20;
    primitive.positions.resize(kVertices);
    primitive.morph_targets.resize(1);
    scene.primitives.push_back(primitive);
    scene.materials.emplace_back();
    scene.instances.resize(sceneBytesMax() / (kVertices * 2 * sizeof(glm::vec3)) + 1);
    messageOf([&] { posedScene(scene, poseAt(scene, 0)); }, ErrorCode::Memory);
}

TEST(Animation, TheWheelsOfTheTruckTurnAndItsBodyStands)
{
    const auto path = sharedScene("milk_truck.glb");
    if (!path)
    {
        GTEST_SKIP() << "milk_truck.glb is not at hand";
    }
    const Scene scene = loadGltf(*path);
    EXPECT_EQ(sceneFault(scene), "");
    ASSERT_EQ(scene.animations.size(), 1U);
    EXPECT_NEAR(scene.animations[0].seconds, 1.25, 1e-6);
    int wheel_count = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        // Wheels are children of the body.
        const bool is_wheel = scene.nodes.at(scene.instances[i].node).parent != kNone;
        EXPECT_EQ(isAnimated(scene, i), is_wheel);
        const glm::mat4& rest = scene.instances[i].transform;
        if (!is_wheel)
        {
            EXPECT_EQ(poseAt(scene, 0.3).transforms[i], rest);
            continue;
        }
        ++wheel_count;
        expectNear(poseAt(scene, 0).transforms[i], rest, 1e-5F);
        const glm::mat4 turned = poseAt(scene, 0.3).transforms[i];
        EXPECT_EQ(turned[3], rest[3]);
        EXPECT_GT(glm::distance(turned[1], rest[1]), 0.1F);
        // A rotation keeps lengths and angles.
        const glm::mat3 linear(turned);
        const glm::mat3 product = glm::transpose(linear) * linear;
        const glm::mat3 wanted = glm::transpose(glm::mat3(rest)) * glm::mat3(rest);
        expectNear(glm::mat4(product), glm::mat4(wanted), 1e-5F);
    }
    EXPECT_EQ(wheel_count, 2);
}

} // namespace

} // namespace zvo::test
