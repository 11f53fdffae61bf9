// SPDX-License-Identifier: MIT
// What a picture should show: everything but far outliers.
#include "core/scene/main_bounds.h"

#include "support/scenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace zvo
{
namespace
{

Scene ballAt(const glm::vec3& where, float radius)
{
    return test::sphereScene(where, radius, 8);
}

Scene both(Scene a, Scene b)
{
    a.append(std::move(b));
    return a;
}

void expectBounds(const Scene& scene, const Bounds& expected)
{
    const Bounds bounds = mainBounds(scene);
    EXPECT_EQ(bounds.min, expected.min);
    EXPECT_EQ(bounds.max, expected.max);
}

void expectSceneBounds(const Scene& scene)
{
    expectBounds(scene, scene.bounds());
}

TEST(MainBounds, LeaveOutSmallThingsFarAway)
{
    const Scene ball = ballAt(glm::vec3(5.0F), 2.0F);
    for (const float distance : {12.0F, 1e3F, 1e9F})
    {
        for (const glm::vec3& way : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, -1), glm::vec3(1, 1, 1)})
        {
            expectBounds(both(ball, ballAt(distance * way, 0.01F)), ball.bounds());
        }
    }
    // One after the other.
    Scene scene = both(ball, ballAt({30.0F, 0.0F, 0.0F}, 0.01F));
    scene = both(std::move(scene), ballAt({0.0F, 1e6F, 0.0F}, 0.02F));
    expectBounds(both(std::move(scene), ballAt({0.0F, 0.0F, -1e12F}, 0.03F)), ball.bounds());
}

TEST(MainBounds, KeepWhatIsNearOrLarge)
{
    const Scene ball = ballAt(glm::vec3(5.0F), 2.0F);
    expectSceneBounds(ball);
    expectSceneBounds(both(ball, ballAt({11.0F, 5.0F, 5.0F}, 0.01F)));  // a gap shorter than the ball
    expectSceneBounds(both(ball, ballAt({1000.0F, 5.0F, 5.0F}, 0.5F))); // a sixteenth of the surface
    expectSceneBounds(both(ball, test::boxScene({4.99F, 7.0F, 4.99F}, {5.01F, 90.0F, 5.01F}))); // a mast, without a gap
    // A row of stepping stones, each farther than the one before, within what lies behind it.
    Scene row = ball;
    for (float x = 9.0F; x < 200.0F; x *= 1.7F)
    {
        row = both(std::move(row), ballAt({x, 5.0F, 5.0F}, 0.1F));
    }
    expectSceneBounds(row);
}

TEST(MainBounds, AreThoseOfTheSceneWhereNothingHasASurface)
{
    EXPECT_TRUE(mainBounds(Scene()).empty());
    expectSceneBounds(test::triangleSoup({glm::vec3(1.0F), glm::vec3(1.0F), glm::vec3(1.0F)}));
    expectSceneBounds(test::triangleSoup({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {90, 90, 90}, {91, 91, 91}, {92, 92, 92}}));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Scene ball = ballAt(glm::vec3(5.0F), 2.0F);
    expectBounds(both(ball, test::triangleSoup({{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}})),
                 both(ball, test::triangleSoup({{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}})).bounds());
}

} // namespace
} // namespace zvo
