// SPDX-License-Identifier: MIT
// Dynamic objects are voxelized from buffers that change in place. The bytes equal those of a scene that is uploaded
// anew.
#include "core/deform/dynamic_object.h"

#include "core/octree/octree_build.h"
#include "core/scene/animation.h"
#include "oracle/morton.h"
#include "runtime/trees.h"
#include "support/deforming_scenes.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/moved_scene.h"
#include "support/octree_access.h"
#include "support/scenes.h"
#include "support/voxel_compare.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace zvo
{
namespace
{

using test::expectEqualsPosed;
using test::kGrid;
using test::Made;
using test::makeAnew;
using test::mixedScene;
using test::MovedScene;

using test::device;

TEST(DynamicObject, OfAllSortsOfInstancesEqualsAnUploadInEveryPose)
{
    std::mt19937 random(21);
    auto [scene, pose] = mixedScene(random);
    MovedScene object(device(), scene);
    EXPECT_EQ(object.mesh().parts.size(), 6U);
    for (int round = 0; round < 3; ++round)
    {
        EXPECT_GT(expectEqualsPosed(object, scene, pose), 5000U);
        test::changePose(random, pose);
    }
}

/// A ball of radius 1 around the origin, without normals. Each vertex has one joint: the first if y > 0, otherwise the
/// second.
Scene flatBall()
{
    Scene scene = test::sphereScene(glm::vec3(0.0F), 1.0F, 24);
    Primitive& ball = scene.primitives.at(0);
    for (const glm::vec3& position : ball.positions)
    {
        ball.joints.emplace_back(position.y > 0.0F ? 0 : 1, 0, 0, 0);
        ball.weights.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
    }
    scene.nodes.resize(2);
    scene.skins.push_back({{0, 1}, {glm::mat4(1.0F), glm::mat4(1.0F)}});
    scene.instances.at(0).skin = 0;
    return scene;
}

TEST(DynamicObject, WithoutNormalsOnJointsThatMirrorEqualsARigidInstance)
{
    const Scene scene = flatBall();
    MovedScene object(device(), scene);
    Scene rigid = test::sphereScene(glm::vec3(0.0F), 1.0F, 24);
    std::set<std::string> shas;
    for (const glm::vec3& scale : {glm::vec3(2, 1, 1.5F), glm::vec3(-2, 1, 1.5F), glm::vec3(-2, -1, 1.5F),
                                   glm::vec3(-2, -1, -1.5F), glm::vec3(2, 1, -1.5F)})
    {
        const glm::mat4 transform = glm::scale(glm::rotate(glm::mat4(1.0F), 0.4F, glm::vec3(0.0F, 0.6F, 0.8F)), scale);
        rigid.instances[0].transform = transform;
        const Pose pose{{glm::mat4(1.0F)}, {{transform, transform}}, {{}}};
        EXPECT_GT(expectEqualsPosed(object, scene, pose), 1000U);
        const std::string sha = makeAnew(rigid).sha;
        EXPECT_EQ(object.make().sha, sha) << scale.x << " " << scale.y << " " << scale.z;
        shas.insert(sha);
    }
    EXPECT_GT(shas.size(), 1U);
}

TEST(DynamicObject, WithoutNormalsEachVertexFollowsTheSideOfItsJoints)
{
    // The upper half is mirrored, the lower one rotated. So the ball is the same, but its upper half is inside out.
    const Scene scene = flatBall();
    MovedScene object(device(), scene);
    const glm::mat4 mirrored = glm::scale(glm::mat4(1.0F), glm::vec3(-2, 2, 2));
    const glm::mat4 turned = glm::scale(glm::mat4(1.0F), glm::vec3(-2, 2, -2));
    const Pose pose{{glm::mat4(1.0F)}, {{mirrored, turned}}, {{}}};
    EXPECT_GT(expectEqualsPosed(object, scene, pose), 1000U);
    const DeviceTree octree =
        buildOctree(device(), {object.uploaded(), object.buffers()}, kGrid, {Coverage::Thin, true, {}}).octree;
    const std::vector<std::uint64_t> codes = voxelCodes(device(), octree);
    const std::vector<gpu::Attribute> attributes = device().download(octree.voxel_attributes);
    int outward[2] = {};
    int inward[2] = {};
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        const glm::dvec3 center = glm::dvec3(kGrid.origin) + (glm::dvec3(oracle::mortonDecode(codes[i])) + 0.5) *
                                                                 static_cast<double>(kGrid.voxel_size);
        if (std::abs(center.y) > 0.5) // outside of the triangles that have both joints
        {
            const double along = glm::dot(test::normalOf(attributes[i]), glm::normalize(center));
            EXPECT_GT(std::abs(along), 0.8);
            ++(along > 0 ? outward : inward)[center.y > 0 ? 1 : 0];
        }
    }
    const int* const right = outward[0] > 0 ? outward : inward; // the direction of the ball's own winding
    const int* const wrong = outward[0] > 0 ? inward : outward;
    EXPECT_GT(right[0], 500);
    EXPECT_GT(right[1], 500);
    EXPECT_EQ(wrong[0] + wrong[1], 0);
}

TEST(DynamicObject, RigidWithAllMaterialsEqualsAnUpload)
{
    std::mt19937 random(22);
    const Scene scene = test::materialsScene(3.0F);
    MovedScene object(device(), scene);
    EXPECT_TRUE(object.mesh().empty());
    EXPECT_EQ(object.buffers().positions.bytes(), 0U) << "it shares the vertices of the scene";
    for (int round = 0; round < 3; ++round)
    {
        std::vector<glm::mat4> transforms;
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
        {
            transforms.push_back(test::randomAffine(random, 2.0F)); // half of them mirror
        }
        Scene moved = scene;
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
        {
            moved.instances[i].transform = transforms[i];
        }
        device().run([&](vk::FrameGraph& graph) { setPose(graph, transforms, object.buffers()); });
        const Made expected = makeAnew(moved);
        EXPECT_EQ(object.make().sha, expected.sha);
        EXPECT_GT(expected.voxel_count, 5000U);
    }
}

TEST(DynamicObject, HasTheVoxelsOfTheOracle)
{
    std::mt19937 random(23);
    const auto [scene, pose] = mixedScene(random);
    MovedScene object(device(), scene);
    object.setPose(pose);
    const Scene posed = posedScene(scene, pose);
    EXPECT_EQ(test::expectEqualsOracle(device(), posed, kGrid, Coverage::Thin), object.make().voxel_count);
}

TEST(DynamicObject, AsItWasUploadedEqualsTheUpload)
{
    const Scene scene = test::materialsScene(3.0F);
    MovedScene object(device(), scene);
    EXPECT_EQ(object.make().sha, makeAnew(scene).sha);
}

TEST(DynamicObject, WithoutWeightsStandsAsAtRest)
{
    std::mt19937 random(24);
    Scene scene;
    Pose pose;
    scene.materials.emplace_back();
    scene.primitives.push_back(test::deformingPrimitive(random, 300, {true, 0, 4}));
    test::addDeforming(random, scene, pose, 0, 0);
    scene.instances[0].transform = pose.transforms[0];
    const Made rest = makeAnew(scene);
    MovedScene object(device(), scene);
    pose.morph_weights[0].assign(4, 0.0F);
    object.setPose(pose);
    EXPECT_EQ(object.make().sha, rest.sha);
    pose.morph_weights[0][0] = 0.5F;
    object.setPose(pose);
    EXPECT_NE(object.make().sha, rest.sha);
}

} // namespace
} // namespace zvo
