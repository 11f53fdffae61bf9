// SPDX-License-Identifier: MIT
#include "core/scene/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace zvo::test
{

namespace
{

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-12;

glm::dvec3 moved(const glm::dmat4& transform, const glm::dvec3& point)
{
    return glm::dvec3(transform * glm::dvec4(point, 1.0));
}

glm::dvec3 movedAt(const Motion& motion, double seconds, const glm::dvec3& point)
{
    return moved(motionAt(motion, seconds), point);
}

void expectNear(const glm::dvec3& point, const glm::dvec3& expected, double tolerance = kRounding)
{
    EXPECT_NEAR(point.x, expected.x, tolerance);
    EXPECT_NEAR(point.y, expected.y, tolerance);
    EXPECT_NEAR(point.z, expected.z, tolerance);
}

void expectAffine(const glm::dmat4& transform)
{
    for (int column = 0; column < 4; ++column)
    {
        EXPECT_EQ(transform[column].w, column == 3 ? 1.0 : 0.0);
    }
}

glm::dvec3 randomVector(std::mt19937& random, double size)
{
    std::uniform_real_distribution<double> number(-size, size);
    const double x = number(random);
    const double y = number(random);
    return {x, y, number(random)};
}

TEST(Motion, NoneIsTheIdentity)
{
    EXPECT_EQ(motionAt(Motion(), 12.5), glm::dmat4(1.0));
}

TEST(Motion, QuarterTurnsAreExact)
{
    // Counterclockwise as seen from the tip of the axis: x to y about z, y to z about x, z to x about y.
    for (int axis = 0; axis < 3; ++axis)
    {
        glm::dvec3 about(0.0);
        about[axis] = 1.0;
        for (int quarters = -9; quarters <= 9; ++quarters)
        {
            const glm::dmat3 rotation = rotationAbout(about, 0.25 * quarters);
            glm::dvec3 from(0.0);
            from[(axis + 1) % 3] = 1.0;
            glm::dvec3 aside(0.0);
            aside[(axis + 2) % 3] = 1.0;
            const glm::dvec3 expected[4] = {from, aside, -from, -aside};
            EXPECT_EQ(rotation * from, expected[(quarters + 12) % 4]) << quarters;
            EXPECT_EQ(rotation * about, about);
        }
    }
}

TEST(Motion, RotationsAreThoseOfGlm)
{
    std::mt19937 random(7);
    for (int i = 0; i < 1000; ++i)
    {
        const glm::dvec3 axis = glm::normalize(randomVector(random, 1.0));
        const double turns = std::uniform_real_distribution<double>(-3.0, 3.0)(random);
        const glm::dvec3 point = randomVector(random, 1.0);
        const glm::dmat4 reference = glm::rotate(glm::dmat4(1.0), 2.0 * kPi * turns, axis);
        expectNear(rotationAbout(axis, turns) * point, moved(reference, point));
    }
}

TEST(Motion, OrbitTurnsThePlacedObjectAboutItsCenter)
{
    OrbitMotion orbit;
    orbit.center = {1.0, 5.0, -2.0};
    orbit.turns_per_second = 0.3;
    orbit.home = {4.0, 0.5, 2.0};
    for (const double seconds : {0.0, 0.1, 0.77, 1.0, 3.9})
    {
        // The rotation about y is counterclockwise from above: a point at angle phi, x = r cos(phi), z = -r sin(phi),
        // moves to phi + a.
        const double angle = 2.0 * kPi * 0.3 * seconds;
        const glm::dvec3 point(2.5, -1.0, 7.0);
        const double radius = std::hypot(point.x - 1.0, point.z + 2.0);
        const double phi = std::atan2(-(point.z + 2.0), point.x - 1.0) + angle;
        expectNear(movedAt(orbit, seconds, point), {1.0 + radius * std::cos(phi), -1.0, -2.0 - radius * std::sin(phi)});
        expectAffine(motionAt(orbit, seconds));
    }
}

TEST(Motion, OrbitMayOnlyCircleOrOnlySpin)
{
    OrbitMotion orbit;
    orbit.center = {1.0, 0.0, 0.0};
    orbit.axis = {0.0, 0.0, 1.0};
    orbit.turns_per_second = 0.25;
    orbit.home = {3.0, 0.0, 0.0};
    orbit.spins = false;
    EXPECT_EQ(movedAt(orbit, 1.0, {3.0, 0.0, 0.0}), glm::dvec3(1.0, 2.0, 0.0));
    EXPECT_EQ(movedAt(orbit, 1.0, {3.5, 0.0, 0.0}), glm::dvec3(1.5, 2.0, 0.0)) << "keeps its orientation";
    orbit.spins = true;
    orbit.circles = false;
    EXPECT_EQ(movedAt(orbit, 1.0, {3.0, 0.0, 0.0}), glm::dvec3(3.0, 0.0, 0.0));
    EXPECT_EQ(movedAt(orbit, 1.0, {3.5, 0.0, 0.0}), glm::dvec3(3.0, 0.5, 0.0)) << "turns in its place";
}

TEST(Motion, LineGoesSteadilyAndBeginsAnew)
{
    LineMotion line;
    line.from = {-1.0, 0.25, 3.0};
    line.to = {7.0, 0.25, -1.0};
    line.seconds = 2.0;
    const auto at = [&](double seconds) { return movedAt(line, seconds, {0.0, 0.0, 0.0}); };
    EXPECT_EQ(at(0.0), line.from);
    EXPECT_EQ(at(0.5), glm::dvec3(1.0, 0.25, 2.0));
    EXPECT_EQ(at(1.5), glm::dvec3(5.0, 0.25, 0.0));
    EXPECT_EQ(at(2.0), line.from);
    EXPECT_EQ(at(6.5), at(0.5));
    line.returns = true;
    EXPECT_EQ(at(0.5), glm::dvec3(3.0, 0.25, 1.0));
    EXPECT_EQ(at(1.0), line.to);
    EXPECT_EQ(at(1.5), at(0.5));
    EXPECT_EQ(at(2.0), line.from);
}

KeyMotion threeKeys()
{
    KeyMotion keys;
    keys.times = {0.5, 1.5, 3.5};
    keys.translations = {{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 8.0, 0.0}};
    const double half = 0.25 * kPi; // of a quarter turn
    keys.rotations = {
        {1.0, 0.0, 0.0, 0.0}, {std::cos(half), 0.0, 0.0, std::sin(half)}, {std::cos(half), 0.0, 0.0, std::sin(half)}};
    keys.scales = {{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, {3.0, 2.0, 1.0}};
    return keys;
}

TEST(Motion, KeysAreMetAndHeldBeforeAndAfter)
{
    const KeyMotion keys = threeKeys();
    const glm::dvec3 point(1.0, 0.0, 0.0);
    expectNear(movedAt(keys, 0.0, point), {1.0, 0.0, 0.0});
    expectNear(movedAt(keys, 0.5, point), {1.0, 0.0, 0.0});
    expectNear(movedAt(keys, 1.5, point), {4.0, 1.0, 0.0});
    expectNear(movedAt(keys, 3.5, point), {4.0, 11.0, 0.0});
    expectNear(movedAt(keys, 100.0, point), {4.0, 11.0, 0.0});
}

TEST(Motion, BetweenKeysRotationsAreSteady)
{
    const KeyMotion keys = threeKeys();
    for (const double part : {0.125, 0.5, 0.8})
    {
        const double angle = part * 0.5 * kPi;
        expectNear(movedAt(keys, 0.5 + part, {1.0, 0.0, 0.0}), {4.0 * part + std::cos(angle), std::sin(angle), 0.0});
        // The scale comes before the rotation, both before the translation.
        expectNear(movedAt(keys, 1.5 + 2.0 * part, {1.0, 1.0, 0.0}),
                   {4.0 - (1.0 + part), 8.0 * part + 1.0 + 2.0 * part, 0.0});
    }
}

TEST(Motion, OneKeyIsAPlace)
{
    KeyMotion keys;
    keys.times = {1.0};
    keys.scales = {{2.0, 0.0, -1.0}};
    for (const double seconds : {0.0, 1.0, 2.0})
    {
        expectNear(movedAt(keys, seconds, {1.0, 1.0, 1.0}), {2.0, 0.0, -1.0});
    }
}

/// Checks that no point leaves the box around the sweep's positions by more than the sweep's bound, and that points
/// come within slack (world units) of it: the bound should not be too large either.
void expectSweepHolds(const Motion& motion, double seconds, double slack)
{
    const MotionSweep sweep = sweepOf(motion, seconds, 16);
    std::mt19937 random(11);
    for (int i = 0; i < 100; ++i)
    {
        const glm::dvec3 point = randomVector(random, 3.0);
        glm::dvec3 low(INFINITY);
        glm::dvec3 high(-INFINITY);
        for (const glm::dmat4& transform : sweep.transforms)
        {
            low = glm::min(low, moved(transform, point));
            high = glm::max(high, moved(transform, point));
        }
        const double stray = sweep.stray + sweep.stray_per_distance * glm::length(point - sweep.pivot) + kRounding;
        glm::dvec3 reached_low(INFINITY);
        glm::dvec3 reached_high(-INFINITY);
        for (int step = 0; step < 4096; ++step)
        {
            const glm::dvec3 at = movedAt(motion, seconds * step / 4096.0, point);
            reached_low = glm::min(reached_low, at);
            reached_high = glm::max(reached_high, at);
        }
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(reached_low, low - stray)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(reached_high, high + stray)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(reached_low, low - stray + slack)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(reached_high, high + stray - slack)));
    }
}

TEST(Motion, SweepHoldsEveryPlaceBetween)
{
    OrbitMotion orbit;
    orbit.center = {2.0, 0.0, 1.0};
    orbit.axis = glm::normalize(glm::dvec3(0.3, 1.0, -0.2));
    orbit.home = {3.0, 1.0, 0.0};
    for (const double rate : {0.11, -0.2, 0.25, 3.0, 0.0})
    {
        orbit.turns_per_second = rate;
        for (const int kind : {0, 1, 2})
        {
            orbit.circles = kind != 1;
            orbit.spins = kind != 2;
            expectSweepHolds(orbit, 4.0, 0.5);
        }
    }
    LineMotion line;
    line.from = {-1.0, 2.0, 3.0};
    line.to = {2.0, 1.0, 8.0};
    line.seconds = 4.0;
    expectSweepHolds(line, 4.0, 0.01);
    line.returns = true;
    expectSweepHolds(line, 4.0, 0.01);
    expectSweepHolds(Motion(), 4.0, 2 * kRounding);
    KeyMotion keys = threeKeys();
    expectSweepHolds(keys, 4.0, 0.2);
    keys.rotations[2] = {std::cos(0.49 * kPi), std::sin(0.49 * kPi), 0.0, 0.0};
    expectSweepHolds(keys, 4.0, 0.6);
}

} // namespace

} // namespace zvo::test
