// SPDX-License-Identifier: MIT
#include "core/scene/scene.h"

#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace zvo
{

namespace
{

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// One image, texture, material and triangle; two instances, the second moved along x by 10.
Scene smallScene()
{
    Scene scene;
    scene.images.push_back({.name = "image", .width = 1, .height = 1, .rgba = {1, 2, 3, 4}});
    scene.textures.push_back({.image = 0});
    Material material;
    material.base_color_texture = 0;
    scene.materials.push_back(material);
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-50, -50, -50}};
    primitive.triangles = {{0, 1, 2}};
    scene.primitives.push_back(primitive);
    glm::mat4 moved(1.0F);
    moved[3].x = 10.0F;
    scene.instances = {{0, glm::mat4(1.0F)}, {0, moved}};
    scene.cameras.emplace_back();
    scene.warnings.emplace_back("warning");
    scene.nodes.resize(3);
    scene.nodes[2].parent = 1;
    scene.skins.push_back({{2, 0}, {glm::mat4(1.0F), glm::mat4(1.0F)}});
    scene.animations.push_back({"turn", {{.node = 1, .times = {0}, .values = {0, 0, 0}}}, 0.0});
    scene.instances[1].node = 2;
    scene.instances[1].skin = 0;
    return scene;
}

TEST(Scene, TrianglesAreCountedWithInstances)
{
    EXPECT_EQ(Scene{}.triangleCount(), 0U);
    EXPECT_EQ(smallScene().triangleCount(), 2U);
}

TEST(Scene, BoundsEncloseTransformedVerticesOfTriangles)
{
    const Bounds bounds = smallScene().bounds();
    EXPECT_EQ(bounds.min, glm::vec3(0, 0, 0));
    EXPECT_EQ(bounds.max, glm::vec3(11, 2, 0));
    EXPECT_TRUE(Scene{}.bounds().empty());
}

TEST(Scene, BoundsLeaveOutVerticesThatAreNotFinite)
{
    Scene scene = smallScene();
    scene.primitives[0].positions[1] = {kNan, 99, 99};
    scene.primitives[0].positions[2] = {99, std::numeric_limits<float>::infinity(), 99};
    const Bounds bounds = scene.bounds();
    EXPECT_EQ(bounds.min, glm::vec3(0, 0, 0));
    EXPECT_EQ(bounds.max, glm::vec3(10, 0, 0));
}

TEST(Scene, AppendShiftsEveryIndex)
{
    Scene scene = smallScene();
    scene.append(smallScene());
    scene.append(Scene{});
    ASSERT_EQ(scene.images.size(), 2U);
    ASSERT_EQ(scene.instances.size(), 4U);
    EXPECT_EQ(scene.textures[1].image, 1U);
    EXPECT_EQ(scene.materials[1].base_color_texture, 1U);
    EXPECT_FALSE(scene.materials[1].emission_texture.has_value());
    EXPECT_EQ(scene.primitives[1].material, 1U);
    EXPECT_EQ(scene.instances[1].primitive, 0U);
    EXPECT_EQ(scene.instances[3].primitive, 1U);
    EXPECT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.warnings.size(), 2U);
    EXPECT_EQ(scene.triangleCount(), 4U);
    ASSERT_EQ(scene.nodes.size(), 6U);
    EXPECT_EQ(scene.nodes[2].parent, 1U);
    EXPECT_EQ(scene.nodes[4].parent, kNone);
    EXPECT_EQ(scene.nodes[5].parent, 4U);
    EXPECT_EQ(scene.skins.at(1).joints, (std::vector<std::uint32_t>{5, 3}));
    EXPECT_EQ(scene.animations.at(1).channels.at(0).node, 4U);
    EXPECT_EQ(scene.instances[1].node, 2U);
    EXPECT_EQ(scene.instances[2].node, kNone);
    EXPECT_EQ(scene.instances[2].skin, kNone);
    EXPECT_EQ(scene.instances[3].node, 5U);
    EXPECT_EQ(scene.instances[3].skin, 1U);
}

TEST(Scene, TransformRoundsEveryOperationInOrder)
{
    // 2^24 + 1 is not representable. The sum is rounded to even after the first two terms, so the ones are lost.
    constexpr float kBig = 16777216.0F;
    glm::mat4 transform(0.0F);
    transform[0][0] = kBig;
    transform[1][0] = 1.0F;
    transform[2][0] = 1.0F;
    transform[3][0] = 1.0F;
    EXPECT_EQ(transformPoint(transform, glm::vec3(1.0F)).x, kBig);
    transform[0][0] = 1.0F;
    transform[3][0] = kBig;
    EXPECT_EQ(transformPoint(transform, glm::vec3(1.0F)).x, kBig + 4.0F); // 3 + 2^24, a tie to even
}

TEST(Scene, TransformDoesNotFuse)
{
    // x * x = 1 + 2^-22 + 2^-46 rounds to 1 + 2^-22; a fused sum would keep 2^-46.
    const float x = 1.0F + 0x1p-23F;
    glm::mat4 transform(0.0F);
    transform[0][0] = -(1.0F + 0x1p-22F);
    transform[1][0] = x;
    EXPECT_EQ(transformPoint(transform, glm::vec3(1.0F, x, 0.0F)).x, 0.0F);
}

} // namespace

} // namespace zvo
