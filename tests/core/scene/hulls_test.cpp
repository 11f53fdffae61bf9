// SPDX-License-Identifier: MIT
// Inverted hulls are left out, and what only looks like one stays.
#include "core/scene/hulls.h"

#include "support/toon_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace zvo
{
namespace
{

using test::addSurface;
using test::place;

const glm::vec4 kRed(1.0F, 0.0F, 0.0F, 1.0F);
const glm::vec4 kDark(0.01F, 0.01F, 0.01F, 1.0F);

Scene ball(float radius = 1.0F)
{
    return test::sphereScene(glm::vec3(0.0F), radius, 8);
}

// A ball with another surface around it; turned: with its back faces outside.
Scene wrappedBall(float scale, bool turned = true)
{
    Scene scene;
    place(scene, addSurface(scene, ball(), kRed), glm::vec3(3.0F), 1.0F);
    place(scene, addSurface(scene, ball(), kDark, turned), glm::vec3(3.0F), scale);
    return scene;
}

// Expects that nothing is left out.
void expectAllKept(Scene scene)
{
    const std::uint64_t triangle_count = scene.triangleCount();
    EXPECT_EQ(leaveOutHulls(scene).hull_count, 0U);
    EXPECT_EQ(scene.triangleCount(), triangle_count);
}

TEST(Hulls, AreLeftOut)
{
    for (const float scale : {1.01F, test::kHullScale, 1.1F})
    {
        Scene scene = wrappedBall(scale);
        const std::uint64_t ball_triangles = scene.primitives[0].triangles.size();
        const LeftOutHulls left_out = leaveOutHulls(scene);
        EXPECT_EQ(left_out.hull_count, 1U) << scale;
        EXPECT_EQ(left_out.triangle_count, ball_triangles);
        EXPECT_EQ(left_out.materials, std::vector<std::string>{"outline"});
        ASSERT_EQ(scene.instances.size(), 1U);
        EXPECT_EQ(scene.instances[0].primitive, 0U);
        EXPECT_EQ(scene.triangleCount(), ball_triangles);
    }
}

TEST(Hulls, AreFoundOneByOneInAPrimitive)
{
    // One primitive has all hulls, and a shell around all of them, which lies close to nothing.
    constexpr int kBalls = 40;
    Scene scene;
    const std::uint32_t red = addSurface(scene, ball(), kRed);
    const std::uint32_t hulls = addSurface(scene, ball(test::kHullScale), kDark, true);
    const Primitive hull = scene.primitives[hulls];
    const Scene shell = test::boxScene(glm::vec3(-50.0F), glm::vec3(200.0F));
    Scene turned;
    scene.primitives[hulls] = turned.primitives[addSurface(turned, shell, kDark, true)];
    scene.primitives[hulls].material = hull.material;
    const std::size_t shell_triangles = scene.primitives[hulls].triangles.size();
    for (int i = 0; i < kBalls; ++i)
    {
        const glm::vec3 where(3.0F * static_cast<float>(i), 0.0F, 0.0F);
        place(scene, red, where, 1.0F);
        Primitive& all = scene.primitives[hulls];
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        std::transform(hull.positions.begin(), hull.positions.end(), std::back_inserter(all.positions),
                       [&](const glm::vec3& position) { return position + where; });
        std::transform(hull.triangles.begin(), hull.triangles.end(), std::back_inserter(all.triangles),
                       [&](const glm::uvec3& triangle) { return triangle + first; });
    }
    place(scene, hulls, glm::vec3(0.0F), 1.0F);
    EXPECT_EQ(leaveOutHulls(scene).hull_count, static_cast<std::uint64_t>(kBalls));
    EXPECT_EQ(scene.primitives[hulls].triangles.size(), shell_triangles);
    EXPECT_EQ(scene.instances.size(), kBalls + 1U);
}

TEST(Hulls, AreSingleSidedAndInsideOut)
{
    expectAllKept(wrappedBall(test::kHullScale, false));
    Scene double_sided = wrappedBall(test::kHullScale);
    double_sided.materials[1].double_sided = true;
    expectAllKept(std::move(double_sided));
}

TEST(Hulls, MirroringTurnsNothingInsideOut)
{
    Scene mirrored = wrappedBall(test::kHullScale, false);
    mirrored.instances[1].transform[0] *= -1.0F;
    expectAllKept(mirrored);
    Scene turned = wrappedBall(test::kHullScale);
    for (Instance& instance : turned.instances)
    {
        instance.transform[0] *= -1.0F;
    }
    EXPECT_EQ(leaveOutHulls(turned).hull_count, 1U);
}

TEST(Hulls, LieCloseToWhatIsInThem)
{
    expectAllKept(wrappedBall(1.5F));
    Scene empty;
    place(empty, addSurface(empty, ball(), kDark, true), glm::vec3(0.0F), 1.0F);
    expectAllKept(std::move(empty));
}

TEST(Hulls, ARoomSeenFromInsideStays)
{
    // Its walls look inwards. Most of what they see is far away.
    Scene room;
    place(room, addSurface(room, test::boxScene(glm::vec3(0.0F), glm::vec3(10.0F, 4.0F, 8.0F)), kRed, true), {}, 1.0F);
    const std::uint32_t cupboard =
        addSurface(room, test::boxScene({0.0F, 0.0F, 0.0F}, {2.0F, 3.0F, 0.6F}), glm::vec4(0.5F));
    place(room, cupboard, {0.05F, 0.0F, 0.05F}, 1.0F);
    place(room, cupboard, {7.0F, 0.0F, 7.3F}, 1.0F);
    expectAllKept(std::move(room));
}

TEST(Hulls, TheInnerSideOfAThickShellStays)
{
    // A bottle with something in it that touches it almost: outer and inner side are one primitive.
    Scene scene;
    const std::uint32_t outer = addSurface(scene, ball(1.2F), kRed);
    Scene turned;
    const Primitive inner = turned.primitives[addSurface(turned, ball(1.05F), kRed, true)];
    Primitive& shell = scene.primitives[outer];
    const auto first = static_cast<std::uint32_t>(shell.positions.size());
    shell.positions.insert(shell.positions.end(), inner.positions.begin(), inner.positions.end());
    for (const glm::uvec3& triangle : inner.triangles)
    {
        shell.triangles.push_back(triangle + first);
    }
    place(scene, outer, {}, 1.0F);
    place(scene, addSurface(scene, ball(), kRed), {}, 1.0F);
    expectAllKept(std::move(scene));
}

TEST(Hulls, AreFoundAmongThousandsOfInstances)
{
    Scene scene = test::toonScene(64);
    const LeftOutHulls left_out = leaveOutHulls(scene);
    EXPECT_EQ(left_out.hull_count, 2U);
    EXPECT_EQ(scene.instances.size(), 64U * 64U + 1U);
}

} // namespace
} // namespace zvo
