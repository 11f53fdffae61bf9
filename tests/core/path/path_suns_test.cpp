// SPDX-License-Identifier: MIT
// Path tracing in the light of small suns: a texel of a map, a disc and its half-shadow, against closed forms.
#include "core/light/environment.h"
#include "core/path/path_tracer.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/path_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace zvo
{
namespace
{

using test::LitVoxel;

constexpr double kHalfTurn = std::numbers::pi;

// A floor and a wall towards +x, so far from each other that neither sends light to the other's middle.
DeviceTree floorAndWall()
{
    std::vector<LitVoxel> voxels;
    const LitVoxel grey = {{}, glm::uvec3(188)};
    test::addBox(voxels, {0, 0, 0}, {8, 1, 8}, grey);
    test::addBox(voxels, {24, 24, 24}, {25, 32, 32}, grey);
    return test::litTree(test::device(), voxels, 5);
}

ViewCamera atTheFloor()
{
    return ViewCamera::lookAt({4.0, 7.0, 4.001}, {4.0, 1.0, 4.0}, 0.1);
}

ViewCamera atTheWall()
{
    return ViewCamera::lookAt({31.0, 28.0, 28.001}, {25.0, 28.0, 28.0}, 0.1);
}

/// A map of width x width / 2 texels, of which one is a sun. Radiance falls linearly from the texel's middle to those
/// beside it: along each axis it is a tent as wide as two texels. Integrals of a tent times a cosine are known: the
/// factor for cos(k t) is that of the middle times (sin(k w / 2) / (k w / 2))^2, w: the width of a texel.
struct TexelSun
{
    std::uint32_t width;
    std::uint32_t column;
    std::uint32_t row;
    double radiance;

    [[nodiscard]] HdrImage map() const
    {
        HdrImage image = {width, width / 2, std::vector<glm::vec3>(std::size_t{width} * (width / 2))};
        image.texels[std::size_t{row} * width + column] = glm::vec3(static_cast<float>(radiance));
        return image;
    }

    [[nodiscard]] double texelAngle() const { return 2.0 * kHalfTurn / width; } // along both edges

    // Of a tent, times that at its middle: the integral of cos(frequency * t).
    [[nodiscard]] double tent(double frequency) const
    {
        const double x = 0.5 * frequency * texelAngle();
        return std::pow(std::sin(x) / x, 2.0);
    }

    [[nodiscard]] double angleFromUp() const { return (row + 0.5) * texelAngle(); }

    // The integral of radiance * cos(t) * sin(t), t from up.
    [[nodiscard]] double irradianceOfFloor() const
    {
        return radiance * texelAngle() * texelAngle() * 0.5 * std::sin(2.0 * angleFromUp()) * tent(2.0);
    }

    // The integral of radiance * sin(t)^2 * cos(s), s: the angle about y from +x, which is at 3/4 of the width.
    [[nodiscard]] double irradianceOfWall(double turn) const
    {
        const double s = (column + 0.5) * texelAngle() - 1.5 * kHalfTurn - turn;
        return radiance * texelAngle() * texelAngle() * 0.5 * (1.0 - std::cos(2.0 * angleFromUp()) * tent(2.0)) *
               std::cos(s) * tent(1.0);
    }
};

TEST(PathSuns, ATexelIsItsSolidAngleTimesTheCosine)
{
    const DeviceTree tree = floorAndWall();
    const double albedo = test::albedoOf({{}, glm::uvec3(188)}).g;
    constexpr double kTurn = 0.2;
    for (const TexelSun& sun : {TexelSun{512, 390, 60, 20000.0}, TexelSun{64, 44, 10, 400.0}})
    {
        DeviceEnvironment sky(test::device().device(), sun.map(), kTurn, 1.0);
        for (const LightSampling way : test::kWays)
        {
            const bool by_chance = way == LightSampling::Chance;
            if (by_chance && sun.width > 64)
            {
                continue; // one direction in 20,000 meets it
            }
            const PathOptions options = {.bounces = 1, .sampling = way};
            const auto expectLight = [&](const ViewCamera& view, double irradiance)
            {
                const double expected = albedo * irradiance / kHalfTurn;
                const test::PathPicture picture = test::pictureOf(tree, sky, view, 16, by_chance ? 1024 : 512, options);
                EXPECT_NEAR(picture.luminance, expected, by_chance ? 3.0 * picture.error : 0.01 * expected);
                EXPECT_LT(picture.error, (by_chance ? 0.04 : 0.004) * expected);
            };
            expectLight(atTheFloor(), sun.irradianceOfFloor());
            expectLight(atTheWall(), sun.irradianceOfWall(kTurn));
        }
    }
}

// The part of a disc of radius 1 beyond a line at distance x from its middle, on the side of smaller x.
double partOfDisc(double x)
{
    const double t = std::clamp(x, -1.0, 1.0);
    return 0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / kHalfTurn;
}

// The half-shadow of an edge is as wide as a disc of 0.53 degrees makes it, from the zenith and from aside.
TEST(PathSuns, AHalfShadowIsThatOfADisc)
{
    constexpr std::uint32_t kHeight = 200; // of the edge above the floor
    constexpr std::uint32_t kColumns = 32;
    constexpr double kSeen = 4.0; // voxels across the picture
    constexpr double kRadius = 0.5 * 0.53 * kHalfTurn / 180.0;
    std::vector<LitVoxel> voxels;
    const LitVoxel grey = {{}, glm::uvec3(188)};
    test::addBox(voxels, {112, 0, 24}, {144, 1, 40}, grey);
    test::addBox(voxels, {118, kHeight + 1, 0}, {128, kHeight + 2, 255}, grey);
    const DeviceTree tree = test::litTree(test::device(), voxels, 8);
    ViewCamera view = ViewCamera::lookAt({128.0, 20.0, 32.0}, {128.0, 1.0, 32.0}, 1.0);
    view.orthographic = true;
    view.half_height = 0.5 * kSeen;
    view.right = {1.0, 0.0, 0.0};
    view.up = {0.0, 0.0, -1.0};
    const double albedo = test::albedoOf(grey).g;
    for (const double tilt : {0.0, 0.6})
    {
        DeviceEnvironment sky = test::constantSky(glm::vec3(0.0F));
        sky.setSun({.direction = {0.0, std::cos(tilt), std::sin(tilt)}, .irradiance = glm::dvec3(1.0)});
        const test::PathPicture picture =
            test::pictureOf(tree, sky, view, kColumns, 32, {.bounces = 1, .sampling = LightSampling::Lights});
        double width = 0.0;
        double expected_width = 0.0;
        for (std::uint32_t x = 0; x < kColumns; ++x)
        {
            double lit = 0.0;
            for (std::uint32_t y = 0; y < kColumns; ++y)
            {
                lit += test::luminanceOf(picture.pixels[y * kColumns + x]) / (albedo * std::cos(tilt) * kColumns);
            }
            // Rays from beyond the edge pass its upper side, the others its lower one.
            const double beyond = ((x + 0.5) / kColumns - 0.5) * kSeen;
            const double radius = kRadius * (kHeight + (beyond > 0.0 ? 1.0 : 0.0)) / std::cos(tilt);
            const double expected = partOfDisc(beyond / radius);
            EXPECT_NEAR(lit, expected, 0.02) << beyond;
            width += lit * (1.0 - lit);
            expected_width += expected * (1.0 - expected);
        }
        EXPECT_NEAR(width, expected_width, 0.02 * expected_width);
    }
}

} // namespace
} // namespace zvo
