// SPDX-License-Identifier: MIT
// Path tracing against known answers: furnaces, form factors, energy, and a path tracer of a few lines.
#include "core/path/path_tracer.h"

#include "core/light/environment.h"
#include "core/scene/camera.h"
#include "oracle/box_paths.h"
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

using test::constantSky;
using test::device;
using test::kWays;
using test::LitVoxel;
using test::luminanceOf;
using test::PathPicture;
using test::pictureOf;
using test::whiteVoxel;

LitVoxel grey()
{
    return {{}, glm::uvec3(188), glm::vec3(0.0F)};
}

ViewCamera outside()
{
    return ViewCamera::lookAt({19.0, 15.0, 23.0}, {4.0, 4.0, 4.0}, 0.4);
}

// A convex body of albedo 1 in a constant sky looks like the sky.
TEST(PathFurnace, AWhiteCubeCannotBeSeen)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {2, 2, 2}, {6, 6, 6}, whiteVoxel());
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = constantSky({0.5F, 1.0F, 2.0F});
    EXPECT_LT(pictureOf(tree, sky, outside(), 16, 1, {.bounces = 0}).mean.g, 0.9) << "it is there";
    for (const LightSampling way : kWays)
    {
        const PathOptions options = {.bounces = 1, .sampling = way};
        const PathPicture picture = pictureOf(tree, sky, outside(), 8, 1024, options);
        EXPECT_NEAR(picture.mean.r, 0.5, 0.0005);
        EXPECT_NEAR(picture.mean.g, 1.0, 0.001);
        EXPECT_NEAR(picture.mean.b, 2.0, 0.002);
    }
}

// What the camera sees of a map may be another one than that which gives light.
TEST(PathTracer, BackgroundsGiveNoLight)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {2, 2, 2}, {6, 6, 6}, whiteVoxel());
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = constantSky(glm::vec3(1.0F));
    sky.setBackground(device().device(), {2, 1, {glm::vec3(0.25F), glm::vec3(0.25F)}});
    for (const LightSampling way : kWays)
    {
        const PathPicture picture = pictureOf(tree, sky, outside(), 8, 256, {.bounces = 1, .sampling = way});
        EXPECT_NEAR(picture.pixels[3 * 8 + 4].r, 1.0, 0.02) << "the cube, at the middle";
        EXPECT_NEAR(picture.pixels[0].r, 0.25, 1e-6) << "beside it";
    }
}

// With so many bounces that all paths get out, so does a body with holes.
TEST(PathFurnace, AWhiteBowlCannotBeSeen)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {8, 1, 8}, whiteVoxel());
    test::addBox(voxels, {0, 1, 0}, {1, 6, 8}, whiteVoxel());
    test::addBox(voxels, {1, 1, 0}, {8, 4, 1}, whiteVoxel());
    test::addBox(voxels, {3, 1, 3}, {5, 3, 5}, whiteVoxel());
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = constantSky(glm::vec3(1.0F));
    EXPECT_LT(pictureOf(tree, sky, outside(), 16, 1, {.bounces = 0}).luminance, 0.6) << "it is there";
    for (const LightSampling way : kWays)
    {
        const PathOptions options = {.bounces = 96, .sampling = way};
        const PathPicture picture = pictureOf(tree, sky, outside(), 16, 128, options);
        EXPECT_NEAR(picture.luminance, 1.0, 0.001 + 3.0 * picture.error);
        EXPECT_LT(picture.error, 0.004);
    }
}

// From inside, a closed white room looks like the sky in its window, and one whose walls glow looks as bright as all
// its bounces together.
TEST(PathFurnace, AWhiteRoomIsAsBrightAsItsLight)
{
    LitVoxel wall = whiteVoxel();
    std::vector<LitVoxel> voxels = test::roomOf(wall, 6);
    std::erase_if(voxels, [](const LitVoxel& v)
                  { return v.cell.x == 5 && v.cell.y > 0 && v.cell.y < 5 && v.cell.z > 0 && v.cell.z < 5; });
    const DeviceTree windowed = test::litTree(device(), voxels, 3);
    wall.emission = glm::vec3(0.5F);
    const DeviceTree glowing = test::litTree(device(), test::roomOf(wall, 6), 3);
    const ViewCamera inside = ViewCamera::lookAt({3.2, 3.1, 3.3}, {1.0, 2.0, 3.0}, 1.0);
    DeviceEnvironment sky = constantSky({0.5F, 1.0F, 2.0F});
    const double sky_light = luminanceOf({0.5, 1.0, 2.0});
    for (const LightSampling way : kWays)
    {
        const PathPicture picture = pictureOf(windowed, sky, inside, 16, 64, {.bounces = 48, .sampling = way});
        // By chance each path has the light of the sky, but for the few that do not get out.
        const double tolerance = 0.001 + (way == LightSampling::Chance ? 0.0 : 3.0 * picture.error);
        EXPECT_NEAR(picture.luminance, sky_light, tolerance * sky_light);
        EXPECT_LT(picture.error, 0.012);
    }
    for (const LightSampling way : {LightSampling::Both, LightSampling::Chance})
    {
        const std::uint32_t edge = way == LightSampling::Chance ? 4 : 16;
        const PathPicture picture = pictureOf(glowing, sky, inside, edge, 1024, {.bounces = 3, .sampling = way});
        EXPECT_NEAR(picture.luminance, 4.0 * 0.5, 0.001 * 4.0 * 0.5);
    }
}

// In a closed room whose walls glow, each bounce adds the walls' albedo to its own power.
TEST(PathEnergy, OfEachBounceIsThePowerOfTheAlbedo)
{
    LitVoxel wall = grey();
    wall.emission = glm::vec3(0.5F);
    const DeviceTree tree = test::litTree(device(), test::roomOf(wall, 8), 3);
    DeviceEnvironment sky = constantSky(glm::vec3(0.0F));
    const ViewCamera inside = ViewCamera::lookAt({4.2, 4.1, 4.3}, {1.0, 2.0, 3.0}, 1.0);
    const double albedo = test::albedoOf(wall).r;
    for (const LightSampling way : kWays)
    {
        double expected = 0.0;
        for (std::uint32_t bounces = 0; bounces <= 4; ++bounces)
        {
            expected += 0.5 * std::pow(albedo, bounces);
            const PathPicture picture = pictureOf(tree, sky, inside, 8, 512, {.bounces = bounces, .sampling = way});
            EXPECT_NEAR(picture.luminance, expected, 1e-5 + 4.0 * picture.error) << bounces;
            EXPECT_LT(picture.error, 0.01);
        }
    }
}

// Below the middle of a square light, at distance h: the form factor of a square (J. R. Howell, A Catalog of Radiation
// Heat Transfer Configuration Factors, B-4, four times).
TEST(PathLight, OfASquareIsItsFormFactor)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {16, 1, 16}, whiteVoxel());
    LitVoxel lamp = whiteVoxel();
    lamp.emission = glm::vec3(1.5F);
    test::addBox(voxels, {6, 9, 6}, {10, 10, 10}, lamp);
    const DeviceTree tree = test::litTree(device(), voxels, 4);
    DeviceEnvironment sky = constantSky(glm::vec3(0.0F));
    // A small part of the floor below the lamp, seen from below the lamp.
    const ViewCamera view = ViewCamera::lookAt({8.0, 4.0, 8.001}, {8.0, 1.0, 8.0}, 0.02);
    const double x = 2.0 / 8.0;
    const double root = std::sqrt(1.0 + x * x);
    const double factor = 4.0 / (2.0 * std::numbers::pi) * 2.0 * (x / root) * std::atan(x / root);
    for (const LightSampling way : kWays)
    {
        const PathOptions options = {.bounces = 1, .sampling = way};
        const PathPicture picture = pictureOf(tree, sky, view, 8, way == LightSampling::Chance ? 4096 : 512, options);
        EXPECT_NEAR(picture.luminance, 1.5 * factor, 0.01 * 1.5 * factor);
    }
}

TEST(PathLight, OfASunIsItsIrradiance)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {8, 1, 8}, grey());
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = constantSky(glm::vec3(0.0F));
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.3, 0.8, 0.2));
    sky.setSun({.direction = to_sun, .irradiance = glm::dvec3(2.0, 3.0, 4.0)});
    const ViewCamera view = ViewCamera::lookAt({4.0, 7.0, 4.001}, {4.0, 1.0, 4.0}, 0.3);
    for (const LightSampling way : {LightSampling::Both, LightSampling::Lights})
    {
        const PathOptions options = {.bounces = 1, .sampling = way};
        const PathPicture picture = pictureOf(tree, sky, view, 8, 64, options);
        const glm::dvec3 expected = test::albedoOf(grey()) * to_sun.y * glm::dvec3(2.0, 3.0, 4.0);
        EXPECT_LT(glm::length(picture.mean - expected), 0.01 * glm::length(expected));
    }
}

// A room with a lamp, coloured walls and a sky that shines in.
std::vector<LitVoxel> room()
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {8, 1, 8}, grey());
    test::addBox(voxels, {0, 1, 0}, {1, 6, 8}, {{}, {220, 60, 40}, glm::vec3(0.0F)});
    test::addBox(voxels, {7, 1, 0}, {8, 6, 6}, {{}, {60, 200, 40}, glm::vec3(0.0F)});
    test::addBox(voxels, {1, 1, 0}, {7, 6, 1}, grey());
    test::addBox(voxels, {3, 1, 3}, {5, 3, 5}, whiteVoxel());
    test::addBox(voxels, {2, 5, 3}, {4, 6, 4}, {{}, {128, 128, 128}, {1.5F, 1.25F, 0.5F}});
    test::addBox(voxels, {6, 2, 2}, {7, 3, 3}, {{}, {128, 128, 128}, {0.25F, 0.5F, 1.75F}});
    return voxels;
}

ViewCamera intoTheRoom()
{
    return ViewCamera::lookAt({4.3, 4.5, 16.0}, {4.0, 2.6, 3.0}, 0.55);
}

glm::dvec3 roomSky(const glm::dvec3& direction)
{
    return glm::dvec3(0.5, 0.6, 0.8) * (0.5 + 0.5 * direction.y);
}

// The sky in so many texels that steps between them do not matter.
DeviceEnvironment roomEnvironment(double turn)
{
    HdrImage picture = {128, 64, {}};
    for (std::uint32_t y = 0; y < picture.height; ++y)
    {
        const double height = std::cos(std::numbers::pi * (y + 0.5) / picture.height);
        picture.texels.insert(picture.texels.end(), picture.width, glm::vec3(roomSky({0.0, height, 0.0})));
    }
    return {device().device(), picture, turn, 1.0};
}

TEST(PathLight, IsThatOfAPathTracerOfBoxes)
{
    const std::vector<LitVoxel> voxels = room();
    std::vector<oracle::PathBox> boxes;
    for (const LitVoxel& voxel : voxels)
    {
        boxes.push_back({glm::dvec3(voxel.cell), test::albedoOf(voxel), glm::dvec3(voxel.emission)});
    }
    constexpr std::uint32_t kEdge = 8;
    constexpr std::uint32_t kBounces = 3;
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = roomEnvironment(0.7);
    const PathPicture picture = pictureOf(tree, sky, intoTheRoom(), kEdge, 512, {.bounces = kBounces});
    const oracle::BoxPaths expected =
        oracle::traceBoxPaths(boxes, roomSky, intoTheRoom().position, intoTheRoom().forward, intoTheRoom().right,
                              intoTheRoom().up, intoTheRoom().vertical_fov, kEdge, 600, kBounces);
    EXPECT_LT(expected.error, 0.01 * luminanceOf(expected.mean));
    const double error = std::hypot(expected.error, picture.error);
    EXPECT_NEAR(picture.luminance, luminanceOf(expected.mean), 3.0 * error);
    for (int i = 0; i < 3; ++i)
    {
        EXPECT_NEAR(picture.mean[i], expected.mean[i], 0.02 * expected.mean[i]);
    }
}

// Trees with and without flags of nodes, in both structures, and every way of finding light.
TEST(PathLight, IsTheSameInEachWay)
{
    const DeviceTree flagged = test::litTree(device(), room(), 3);
    const DeviceTree plain = test::litTree(device(), room(), 3, false);
    DeviceEnvironment sky = roomEnvironment(0.0);
    sky.setSun({.direction = {0.5, 1.0, 0.7}, .irradiance = glm::dvec3(0.7), .angle = 0.2});
    const PathPicture both = pictureOf(flagged, sky, intoTheRoom(), 16, 128, {});
    EXPECT_EQ(pictureOf(plain, sky, intoTheRoom(), 16, 128, {}).pixels, both.pixels);
    EXPECT_LT(both.error, 0.01 * both.luminance);
    const auto expectSame = [](const PathPicture& a, const PathPicture& b)
    { EXPECT_NEAR(a.luminance, b.luminance, 3.0 * std::hypot(a.error, b.error)); };
    const PathPicture chance = pictureOf(flagged, sky, intoTheRoom(), 16, 512, {.sampling = LightSampling::Chance});
    const PathPicture lights = pictureOf(flagged, sky, intoTheRoom(), 16, 512, {.sampling = LightSampling::Lights});
    expectSame(chance, both);
    expectSame(lights, both);
    expectSame(chance, lights);
    expectSame(pictureOf(flagged, sky, intoTheRoom(), 16, 256, {.roulette = true}), both);
}

} // namespace
} // namespace zvo
