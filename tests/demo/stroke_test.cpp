// SPDX-License-Identifier: MIT
// Which voxels on the way of the pointer become dabs, when looks are answered late.
#include "core/edit/voxel_clip.h"
#include "demo/input/pointer_ray.h"
#include "demo/world/mirror.h"
#include "demo/world/stroke.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace zvo::demo
{
namespace
{

// Frames whose looks are answered late. The window shows a wall of voxels, each of them four units wide.
class LateAnswers
{
public:
    explicit LateAnswers(std::size_t late, DabSpacing spacing = {}) : m_late(late), m_spacing(spacing) {}

    void frame(Stroke& stroke)
    {
        std::vector<std::optional<glm::ivec3>> voxels;
        for (const glm::dvec2& at : stroke.takePoints())
        {
            points.push_back(at);
            voxels.push_back(at.x < hole_begin || at.x >= hole_end ? std::optional(glm::ivec3(at.x / 4, at.y / 4, 0))
                                                                   : std::nullopt);
        }
        m_looks.push_back(voxels);
        if (m_looks.size() > m_late)
        {
            for (const glm::ivec3& dab : stroke.found(m_looks.front(), m_spacing))
            {
                dabs.push_back(dab);
            }
            ends += stroke.takeEnd() ? 1 : 0;
            m_looks.pop_front();
        }
    }

    void finish(Stroke& stroke)
    {
        for (int i = 0; i < 10; ++i)
        {
            frame(stroke);
        }
    }

    double hole_begin = 1e9; // through which nothing is seen
    double hole_end = 1e9;
    std::vector<glm::dvec2> points;
    std::vector<glm::ivec3> dabs;
    int ends = 0;

private:
    std::size_t m_late;
    DabSpacing m_spacing;
    std::deque<std::vector<std::optional<glm::ivec3>>> m_looks;
};

double largestGap(const std::vector<glm::ivec3>& dabs)
{
    double gap = 0;
    for (std::size_t i = 1; i < dabs.size(); ++i)
    {
        gap = std::max(gap, glm::distance(glm::dvec3(dabs[i - 1]), glm::dvec3(dabs[i])));
    }
    return gap;
}

TEST(Stroke, HasNoGapsHoweverFastThePointerMoves)
{
    for (const std::size_t late : {0U, 1U, 3U})
    {
        for (const double step : {1.0, 7.0, 80.0, 700.0})
        {
            SCOPED_TRACE(std::to_string(late) + " frames late, " + std::to_string(step) + " units a frame");
            Stroke stroke;
            LateAnswers answers(late, {.step = 2, .reach = 20});
            stroke.move({500, 0}); // while the button is up
            answers.frame(stroke);
            EXPECT_TRUE(answers.points.empty());
            stroke.press({0, 0});
            for (double x = 0; x < 1400; x += step)
            {
                stroke.move({x, x / 2});
                answers.frame(stroke);
            }
            stroke.move({1400, 700});
            stroke.release();
            stroke.move({0, 0});
            answers.finish(stroke);
            EXPECT_EQ(answers.ends, 1);
            EXPECT_FALSE(stroke.isActive());
            ASSERT_FALSE(answers.dabs.empty());
            EXPECT_EQ(answers.dabs.front(), glm::ivec3(0));
            EXPECT_LT(glm::distance(glm::dvec3(answers.dabs.back()), glm::dvec3(350, 175, 0)), 2.0);
            EXPECT_LE(largestGap(answers.dabs), 3.0) << "the step, and rounding";
            EXPECT_GE(answers.dabs.size(), 190U);
            EXPECT_LE(answers.dabs.size(), 400U) << "not closer together than needed";
        }
    }
}

TEST(Stroke, JoinsVoxelsThatAreFarFromEachOtherButNotOverAHoleOrAJump)
{
    const auto stroke = [](const std::vector<std::optional<glm::ivec3>>& voxels)
    {
        Stroke made;
        made.press({0, 0});
        made.move({2.0 * static_cast<double>(voxels.size() - 1), 0});
        EXPECT_EQ(made.takePoints().size(), voxels.size());
        return made.found(voxels, {.step = 3, .reach = 12});
    };
    using Dabs = std::vector<glm::ivec3>;
    EXPECT_EQ(stroke({glm::ivec3(0), glm::ivec3(0, 0, 9)}), (Dabs{{0, 0, 0}, {0, 0, 3}, {0, 0, 6}, {0, 0, 9}}));
    EXPECT_EQ(stroke({glm::ivec3(0), glm::ivec3(0, 0, 2)}), Dabs{glm::ivec3(0)});
    EXPECT_EQ(stroke({glm::ivec3(0), glm::ivec3(0, 0, 13)}), (Dabs{{0, 0, 0}, {0, 0, 13}})) << "something behind";
    EXPECT_EQ(stroke({glm::ivec3(0), std::nullopt, glm::ivec3(0, 9, 0)}), (Dabs{{0, 0, 0}, {0, 9, 0}}));
}

TEST(Stroke, ALineBeginsAtTheLastDabOfTheLastStroke)
{
    Stroke stroke;
    LateAnswers answers(1, {.step = 5, .reach = 6});
    answers.hole_begin = 41; // seen again from 60 on
    answers.hole_end = 60;
    stroke.press({0, 0}, true); // there is no last dab
    stroke.move({50, 0});
    stroke.release();
    answers.finish(stroke);
    const std::size_t before = answers.dabs.size();
    stroke.press({50, 0}, true); // nothing is seen there
    stroke.release();
    answers.finish(stroke);
    EXPECT_EQ(answers.dabs.size(), before);
    stroke.press({80, 40}, true);
    stroke.release();
    answers.finish(stroke);
    ASSERT_EQ(answers.dabs.size(), before + 3);
    EXPECT_EQ(answers.dabs[before - 1], glm::ivec3(10, 0, 0));
    EXPECT_EQ(answers.dabs[before], glm::ivec3(13, 3, 0));
    EXPECT_EQ(answers.dabs.back(), glm::ivec3(20, 10, 0));
    EXPECT_EQ(answers.ends, 3);
}

TEST(Stroke, AFrameLooksAtSoManyPointsAndTheNextOneGoesOn)
{
    Stroke stroke;
    stroke.press({0, 0});
    stroke.move({2.0 * static_cast<double>(Stroke::kLooksMax) + 100, 0});
    stroke.release();
    EXPECT_EQ(stroke.takePoints().size(), Stroke::kLooksMax);
    EXPECT_EQ(stroke.takePoints().size(), 51U);
    EXPECT_TRUE(stroke.takePoints().empty());
    EXPECT_FALSE(stroke.takeEnd());
}

TEST(Stroke, AClickWithinAFrameIsADab)
{
    for (const std::size_t late : {0U, 2U})
    {
        Stroke stroke;
        LateAnswers answers(late);
        stroke.press({5, 5});
        stroke.release();
        answers.finish(stroke);
        EXPECT_EQ(answers.dabs, std::vector{glm::ivec3(1, 1, 0)});
        EXPECT_EQ(answers.ends, 1);
    }
}

TEST(Stroke, AClickBeforeTheLastOneWasAnsweredLosesNothingAndIsNotJoinedToIt)
{
    Stroke stroke;
    LateAnswers answers(2, {.step = 1, .reach = 100});
    stroke.press({0, 0});
    stroke.release();
    answers.frame(stroke);
    stroke.press({200, 0});
    stroke.release();
    answers.finish(stroke);
    EXPECT_EQ(answers.dabs, (std::vector{glm::ivec3(0), glm::ivec3(50, 0, 0)}));
    EXPECT_EQ(answers.ends, 1);
}

TEST(Stroke, WhereNothingIsFoundThereIsNoDabButAnEnd)
{
    Stroke stroke;
    LateAnswers answers(1);
    answers.hole_begin = 0;
    stroke.press({5, 5});
    stroke.release();
    answers.finish(stroke);
    EXPECT_TRUE(answers.dabs.empty());
    EXPECT_EQ(answers.ends, 1);
}

TEST(Mirror, HasEachImageOnce)
{
    const Grid grid{.origin = {}, .voxel_size = 1.0F, .depth = 4};
    using Voxels = std::vector<glm::ivec3>;
    EXPECT_EQ(imagesOf(glm::ivec3(1, 2, 3), {}, grid), (Voxels{{1, 2, 3}}));
    EXPECT_EQ(imagesOf(glm::ivec3(1, 2, 3), {.axes = {true, false, true}}, grid),
              (Voxels{{1, 2, 3}, {14, 2, 3}, {1, 2, 12}, {14, 2, 12}}));
    const Mirror through = {.axes = {true, false, false}, .at = glm::ivec3(4, 0, 0)};
    EXPECT_EQ(imagesOf(glm::ivec3(1, 2, 3), through, grid), (Voxels{{1, 2, 3}, {7, 2, 3}}));
    EXPECT_EQ(imagesOf(glm::ivec3(4, 2, 3), through, grid), (Voxels{{4, 2, 3}})) << "in the plane";
    const Brush box = {.shape = BrushShape::Box, .center = {1, 2, 3}, .radius = 1, .span = {2, 1, 0}};
    EXPECT_EQ(imagesOf(box, through, grid).at(1).box(), (VoxelBox{{4, 1, 2}, {8, 4, 4}}));
}

TEST(Mirror, AStampsImageStandsAtTheOtherSide)
{
    const Grid grid{.origin = {}, .voxel_size = 1.0F, .depth = 4};
    VoxelClip clip({2, 1, 1});
    clip.set({0, 0, 0}, ClipVoxel{{5, 0}, 0});
    Brush brush = {.action = BrushAction::Fill, .stamp = clip.stampAt({3, 4, 5}, grid)};
    const std::vector<Brush> images = imagesOf(brush, {.axes = {true, false, false}}, grid);
    ASSERT_EQ(images.size(), 2U);
    EXPECT_EQ(images[1].stamp->box, (VoxelBox{{11, 4, 5}, {12, 4, 5}}));
    EXPECT_TRUE(VoxelClip(*images[1].stamp).at({1, 0, 0}));
    const Mirror far = {.axes = {true, false, false}, .at = glm::ivec3(15, 0, 0)};
    EXPECT_EQ(imagesOf(brush, far, grid).size(), 1U) << "the image is outside of the grid";
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
    for (const glm::dvec2& at : {glm::dvec2(0, 0), glm::dvec2(130, 77)})
    {
        const PointerRay ray = pointerRay(camera, at, size);
        const std::optional<glm::dvec2> seen = pointOf(camera, ray.origin + 3.0 * ray.direction, size);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->x, at.x, 1e-9);
        EXPECT_NEAR(seen->y, at.y, 1e-9);
    }
    EXPECT_FALSE(pointOf(camera, {0, 0, 1}, size)) << "behind the camera";
    camera.orthographic = true;
    camera.half_height = 4;
    const PointerRay ray = pointerRay(camera, {200, 100}, size);
    EXPECT_EQ(ray.origin, glm::dvec3(8, -4, 0));
    EXPECT_EQ(ray.direction, camera.forward);
}

} // namespace
} // namespace zvo::demo
