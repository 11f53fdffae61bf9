// SPDX-License-Identifier: MIT
// Interpolation between keys against other formulas: rotation matrices from an axis and an angle, Hermite splines as
// Bezier curves.
#include "core/scene/animation.h"

#include "animation_scenes.h"
#include "io/gltf/gltf_builder.h"
#include "io/gltf/rig_documents.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace zvo::test
{

namespace
{

constexpr double kPi = std::numbers::pi;

/// The rotation matrix by Rodrigues' formula. axis: of length 1.
glm::mat4 rotationBy(const glm::dvec3& axis, double angle)
{
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 3; ++column)
    {
        glm::dvec3 unit(0.0);
        unit[column] = 1.0;
        const glm::dvec3 turned = unit * std::cos(angle) + glm::cross(axis, unit) * std::sin(angle) +
                                  axis * (glm::dot(axis, unit) * (1.0 - std::cos(angle)));
        matrix[column] = glm::dvec4(turned, 0.0);
    }
    return glm::mat4(matrix);
}

/// The quaternion x, y, z, w of a rotation.
std::vector<float> quaternionOf(const glm::dvec3& axis, double angle, double length = 1.0)
{
    const glm::dvec3 xyz = axis * (std::sin(angle / 2) * length);
    return {static_cast<float>(xyz.x), static_cast<float>(xyz.y), static_cast<float>(xyz.z),
            static_cast<float>(std::cos(angle / 2) * length)};
}

void append(std::vector<float>& into, const std::vector<float>& more)
{
    into.insert(into.end(), more.begin(), more.end());
}

/// A cubic Hermite segment of that many seconds as a Bezier curve, by de Casteljau's construction.
double bezier(double from, double leaving, double to, double arriving, double seconds, double fraction)
{
    double p[4] = {from, from + leaving * seconds / 3, to - arriving * seconds / 3, to};
    for (int left = 3; left > 0; --left)
    {
        for (int i = 0; i < left; ++i)
        {
            p[i] += (p[i + 1] - p[i]) * fraction;
        }
    }
    return p[0];
}

TEST(Animation, StepHoldsEachKeyUntilTheNext)
{
    const Scene scene = movedBy({.path = ChannelPath::Translation,
                                 .interpolation = Interpolation::Step,
                                 .times = {1, 2, 4},
                                 .values = {1, 0, 0, 2, 0, 0, 3, 0, 0}});
    for (const auto& [seconds, x] : {std::pair(0.0, 1.0F), std::pair(1.0, 1.0F), std::pair(1.999, 1.0F),
                                     std::pair(2.0, 2.0F), std::pair(3.999, 2.0F), std::pair(4.0, 1.0F)})
    {
        EXPECT_EQ(transformAt(scene, seconds)[3], glm::vec4(x, 0, 0, 1)) << seconds;
    }
}

TEST(Animation, LinearRunsStraightBetweenKeys)
{
    Scene scene = movedBy({.path = ChannelPath::Translation,
                           .interpolation = Interpolation::Linear,
                           .times = {1, 2, 4},
                           .values = {1, -2, 3, 5, 6, 7, -3, 0, 8}});
    scene.animations[0].channels.push_back({.path = ChannelPath::Scale,
                                            .interpolation = Interpolation::Linear,
                                            .times = {0, 8},
                                            .values = {1, 1, 1, -3, 5, 0}});
    scene.animations[0].seconds = 8;
    const auto expectAt = [&](double seconds, const glm::vec3& translation, const glm::vec3& scale)
    {
        glm::mat4 wanted(1.0F);
        wanted[3] = glm::vec4(translation, 1);
        for (int axis = 0; axis < 3; ++axis)
        {
            wanted[axis][axis] = scale[axis];
        }
        EXPECT_EQ(transformAt(scene, seconds), wanted) << seconds;
    };
    expectAt(0, {1, -2, 3}, {1, 1, 1}); // before the first key
    expectAt(1, {1, -2, 3}, {0.5F, 1.5F, 0.875F});
    expectAt(1.25, {2, 0, 4}, {0.375F, 1.625F, 0.84375F});
    expectAt(2, {5, 6, 7}, {0, 2, 0.75F});
    expectAt(3, {1, 3, 7.5F}, {-0.5F, 2.5F, 0.625F});
    expectAt(6, {-3, 0, 8}, {-2, 4, 0.25F}); // after the last key of one channel, between those of the other
}

TEST(Animation, RotationsTakeTheShorterArcAtConstantSpeed)
{
    std::mt19937 random(3); // NOLINT: the same on every run
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i)
    {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(number(random), number(random), number(random) + 1e-3));
        const double from = number(random) * kPi;
        // The rotations differ by less than half a turn; every tenth pair is nearly or wholly equal.
        const double turn = i % 10 == 0 ? number(random) * 1e-7 : i % 10 == 1 ? 0.0 : number(random) * 3.14;
        Channel channel = {
            .path = ChannelPath::Rotation, .interpolation = Interpolation::Linear, .times = {0, 2, 3}, .values = {}};
        const double sign = i % 2 == 0 ? 1.0 : -1.0; // both signs give the same rotation
        append(channel.values, quaternionOf(axis, from, 1.0 + 0.5 * number(random)));
        append(channel.values, quaternionOf(axis, from + turn, sign * (1.0 + 0.5 * number(random))));
        append(channel.values, {0, 0, 0, 0});
        const Scene scene = movedBy(channel);
        const double fraction = 0.5 + 0.5 * number(random);
        SCOPED_TRACE(i);
        expectNear(transformAt(scene, 2.0 * fraction), rotationBy(axis, from + turn * fraction), 1e-6F);
        expectNear(transformAt(scene, 0.0), rotationBy(axis, from), 1e-6F);
    }
}

TEST(Animation, RotationsOfHalfATurnGoSomeWayRound)
{
    // Both ways are equally short. By the rule, the one to the quaternion as written counts.
    const Scene scene = movedBy({.path = ChannelPath::Rotation,
                                 .interpolation = Interpolation::Linear,
                                 .times = {0, 1, 2},
                                 .values = {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0}});
    expectNear(transformAt(scene, 0.5), rotationBy({0, 0, 1}, kPi / 2), 1e-6F);
    expectNear(transformAt(scene, 0.25), rotationBy({0, 0, 1}, kPi / 4), 1e-6F);
    expectNear(transformAt(scene, 1.5), rotationBy({0, 0, 1}, kPi), 1e-6F);
}

TEST(Animation, QuaternionsOfLengthZeroDoNotRotate)
{
    const Scene scene = movedBy({.path = ChannelPath::Rotation,
                                 .interpolation = Interpolation::Linear,
                                 .times = {0, 1, 2},
                                 .values = {0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1}});
    EXPECT_EQ(transformAt(scene, 0.0), glm::mat4(1.0F));
    expectNear(transformAt(scene, 0.5), rotationBy({0, 0, 1}, kPi / 4), 1e-6F);
}

TEST(Animation, CubicSplinesAreHermiteCurves)
{
    std::mt19937 random(4); // NOLINT: the same on every run
    std::uniform_real_distribution<float> number(-3.0F, 3.0F);
    for (int i = 0; i < 500; ++i)
    {
        Channel channel = {.path = ChannelPath::Translation,
                           .interpolation = Interpolation::CubicSpline,
                           .times = {0.5F, 1.75F, 2},
                           .values = {}};
        for (int k = 0; k < 27; ++k)
        {
            channel.values.push_back(number(random));
        }
        const Scene scene = movedBy(channel);
        const auto value = [&](int key, int part, int axis) -> double
        { return channel.values[9 * key + 3 * part + axis]; };
        const double fraction = (number(random) + 3.0F) / 6.01F;
        const glm::mat4 first = transformAt(scene, 0.5 + 1.25 * fraction);
        const glm::mat4 second = transformAt(scene, 1.75 + 0.25 * fraction);
        for (int axis = 0; axis < 3; ++axis)
        {
            constexpr int kIn = 0;
            constexpr int kValue = 1;
            constexpr int kOut = 2;
            EXPECT_NEAR(first[3][axis],
                        bezier(value(0, kValue, axis), value(0, kOut, axis), value(1, kValue, axis),
                               value(1, kIn, axis), 1.25, fraction),
                        2e-6);
            EXPECT_NEAR(second[3][axis],
                        bezier(value(1, kValue, axis), value(1, kOut, axis), value(2, kValue, axis),
                               value(2, kIn, axis), 0.25, fraction),
                        2e-6);
            EXPECT_EQ(transformAt(scene, 0.0)[3][axis],
                      channel.values[3 + axis]); // the value itself, not the tangents beside it
        }
    }
}

TEST(Animation, CubicRotationsAreNormalized)
{
    // With tangents of 0, the quaternion half way is the mean of both, whose direction is the middle rotation.
    std::vector<float> values(24);
    const std::vector<float> from = quaternionOf({0, 1, 0}, 0.4);
    const std::vector<float> to = quaternionOf({0, 1, 0}, 1.4);
    std::copy(from.begin(), from.end(), values.begin() + 4);
    std::copy(to.begin(), to.end(), values.begin() + 16);
    const Scene scene = movedBy({.path = ChannelPath::Rotation,
                                 .interpolation = Interpolation::CubicSpline,
                                 .times = {0, 2},
                                 .values = values});
    expectNear(transformAt(scene, 1.0), rotationBy({0, 1, 0}, 0.9), 1e-6F);
    // A quarter along the curve, the weights are 27/32 and 5/32.
    const double x = 27.0 / 32.0 * std::sin(0.2) + 5.0 / 32.0 * std::sin(0.7);
    const double w = 27.0 / 32.0 * std::cos(0.2) + 5.0 / 32.0 * std::cos(0.7);
    expectNear(transformAt(scene, 0.5), rotationBy({0, 1, 0}, 2.0 * std::atan2(x, w)), 1e-6F);
}

TEST(Animation, WeightsOfAllTargetsMoveTogether)
{
    GltfBuilder builder = morphDocument({0.5F, -1});
    addAnimation<float>(builder, 0, "weights", "LINEAR", {1, 2, 3}, "SCALAR", kF32, 6, {0, 1, 4, 2, 8, 8});
    const Scene scene = builder.load();
    const auto weightsAt = [&](double seconds) { return poseAt(scene, seconds).morph_weights.at(0); };
    EXPECT_EQ(weightsAt(0.5), (std::vector<float>{0, 1}));
    EXPECT_EQ(weightsAt(1.25), (std::vector<float>{1, 1.25F}));
    EXPECT_EQ(weightsAt(2), (std::vector<float>{4, 2}));
    EXPECT_EQ(poseAt(scene, 2).transforms.at(0), glm::mat4(1.0F));
    EXPECT_EQ(poseAt(morphDocument({0.5F, -1}).load(), 7).morph_weights.at(0), (std::vector<float>{0.5F, -1}));
}

TEST(Animation, WeightsOfASplineHaveTangentsForAllTargets)
{
    GltfBuilder builder = morphDocument({});
    // Incoming tangents, values, outgoing tangents of two targets; two keys.
    const std::vector<float> values = {9, 9, 1, 10, 2, 0, 0, -8, 3, 20, 9, 9};
    addAnimation(builder, 0, "weights", "CUBICSPLINE", {0, 2}, "SCALAR", kF32, 12, values);
    const std::vector<float> weights = poseAt(builder.load(), 1).morph_weights.at(0);
    EXPECT_NEAR(weights.at(0), bezier(1, 2, 3, 0, 2, 0.5), 1e-6);
    EXPECT_NEAR(weights.at(1), bezier(10, 0, 20, -8, 2, 0.5), 1e-6);
}

TEST(Animation, TimesRepeat)
{
    const Scene scene = movedBy({.path = ChannelPath::Translation,
                                 .interpolation = Interpolation::Linear,
                                 .times = {0, 1.5F, 4},
                                 .values = {0, 0, 0, 3, 1, 0, 0, 0, 7}});
    for (double seconds = 0; seconds < 4; seconds += 0.125)
    {
        for (const double turns : {1.0, 1000.0, 1e9, -1.0, -123456.0})
        {
            EXPECT_EQ(transformAt(scene, seconds + 4 * turns), transformAt(scene, seconds)) << seconds << ' ' << turns;
        }
    }
    EXPECT_EQ(transformAt(scene, -1e-300), transformAt(scene, 0));
    for (const double seconds : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()})
    {
        EXPECT_EQ(transformAt(scene, seconds), transformAt(scene, 0));
    }
    const Scene single = movedBy({.path = ChannelPath::Translation, .times = {0}, .values = {1, 2, 3}});
    EXPECT_EQ(transformAt(single, 5)[3], glm::vec4(1, 2, 3, 1));
}

TEST(Animation, EachAnimationHasItsOwnLengthAndTheLastOneCounts)
{
    Scene scene = movedBy({.path = ChannelPath::Translation, .times = {0, 2}, .values = {0, 0, 0, 2, 0, 0}});
    scene.animations.push_back(
        {"", {{.path = ChannelPath::Scale, .times = {0, 3}, .values = {1, 1, 1, 4, 1, 1}}}, 3.0});
    EXPECT_EQ(transformAt(scene, 2.5)[3].x, 0.5F); // 0.5 s of the first
    EXPECT_EQ(transformAt(scene, 2.5)[0].x, 3.5F);
    EXPECT_EQ(transformAt(scene, 3.5)[3].x, 1.5F);
    EXPECT_EQ(transformAt(scene, 3.5)[0].x, 1.5F);
    scene.animations.push_back({"", {{.path = ChannelPath::Translation, .times = {0}, .values = {9, 0, 0}}}, 0.0});
    EXPECT_EQ(transformAt(scene, 2.5)[3].x, 9.0F);
}

} // namespace

} // namespace zvo::test
