// SPDX-License-Identifier: MIT
// Which voxels under the pointer become dabs, when looks are answered late.
#include "demo/input/pointer_ray.h"
#include "demo/world/stroke.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <vector>

namespace zvo::demo
{
namespace
{

// Frames whose probes are answered late.
class LateAnswers
{
public:
    explicit LateAnswers(std::size_t late) : m_late(late) {}

    void frame(Stroke& stroke)
    {
        m_probes.push_back(stroke.probe());
        if (m_probes.size() > m_late)
        {
            if (stroke.found(m_probes.front(), true))
            {
                dabs.push_back(m_probes.front());
            }
            ends += stroke.takeEnd() ? 1 : 0;
            m_probes.pop_front();
        }
    }

    std::vector<std::uint64_t> dabs; // probes that became dabs
    int ends = 0;

private:
    std::size_t m_late;
    std::deque<std::uint64_t> m_probes;
};

TEST(Stroke, ADabForEachPlaceOfThePointerAndOneEnd)
{
    for (const std::size_t late : {0U, 1U, 2U, 3U})
    {
        SCOPED_TRACE(late);
        Stroke stroke;
        LateAnswers answers(late);
        answers.frame(stroke);
        stroke.move(); // while the button is released
        answers.frame(stroke);
        EXPECT_TRUE(answers.dabs.empty());
        stroke.press();
        answers.frame(stroke);
        answers.frame(stroke); // no move, so no other dab
        stroke.move();
        stroke.move();
        answers.frame(stroke);
        stroke.release();
        for (int i = 0; i < 5; ++i)
        {
            answers.frame(stroke);
        }
        EXPECT_EQ(answers.dabs.size(), 2U);
        EXPECT_EQ(answers.ends, 1);
        EXPECT_FALSE(stroke.isActive());
    }
}

TEST(Stroke, AClickWithinAFrameIsADab)
{
    for (const std::size_t late : {0U, 2U})
    {
        Stroke stroke;
        LateAnswers answers(late);
        stroke.press();
        stroke.release();
        for (int i = 0; i < 5; ++i)
        {
            answers.frame(stroke);
        }
        EXPECT_EQ(answers.dabs.size(), 1U);
        EXPECT_EQ(answers.ends, 1);
    }
}

TEST(Stroke, AClickBeforeTheLastOneWasAnsweredLosesNothing)
{
    Stroke stroke;
    LateAnswers answers(2);
    stroke.press();
    stroke.release();
    answers.frame(stroke);
    stroke.press();
    stroke.release();
    for (int i = 0; i < 6; ++i)
    {
        answers.frame(stroke);
    }
    EXPECT_EQ(answers.dabs.size(), 2U);
    EXPECT_EQ(answers.ends, 1);
}

TEST(Stroke, WhereNothingIsFoundThereIsNoDabButAnEnd)
{
    Stroke stroke;
    stroke.press();
    stroke.release();
    EXPECT_FALSE(stroke.found(stroke.probe() - 1, true)) << "of an older pointer";
    EXPECT_FALSE(stroke.takeEnd());
    EXPECT_FALSE(stroke.found(stroke.probe(), false));
    EXPECT_TRUE(stroke.takeEnd());
    EXPECT_FALSE(stroke.takeEnd());
}

TEST(PointerRay, GoesThroughThePixel)
{
    ViewCamera camera; // at the origin, along -z
    camera.vertical_fov = 1.0;
    const glm::dvec2 size(200, 100);
    const double half = std::tan(0.5);
    EXPECT_EQ(pointerRay(camera, {100, 50}, size).direction, glm::dvec3(0, 0, -1));
    const glm::dvec3 corner = pointerRay(camera, {0, 0}, size).direction;
    EXPECT_NEAR(corner.x, -2 * half, 1e-12);
    EXPECT_NEAR(corner.y, half, 1e-12);
    const glm::dvec3 on_plane = onPlane(pointerRay(camera, {0, 0}, size), camera, {5, 5, -3});
    EXPECT_NEAR(on_plane.z, -3, 1e-12);
    EXPECT_NEAR(on_plane.x, -6 * half, 1e-12);
    camera.orthographic = true;
    camera.half_height = 4;
    const PointerRay ray = pointerRay(camera, {200, 100}, size);
    EXPECT_EQ(ray.origin, glm::dvec3(8, -4, 0));
    EXPECT_EQ(ray.direction, camera.forward);
}

} // namespace
} // namespace zvo::demo
