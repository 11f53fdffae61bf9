// SPDX-License-Identifier: MIT
// What the camera sees, shaded by the normals of voxels (PathOptions::smooth), against known answers.
#include "core/path/path_tracer.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/path_pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

ViewCamera outside()
{
    return ViewCamera::lookAt({19.0, 15.0, 23.0}, {4.0, 4.0, 4.0}, 0.4);
}

// A body with a step, and all kinds of normals.
DeviceTree obliqueBody(std::vector<LitVoxel> voxels = {})
{
    test::addBox(voxels, {2, 2, 2}, {6, 3, 6}, whiteVoxel());
    test::addBox(voxels, {2, 3, 2}, {4, 4, 6}, whiteVoxel());
    DeviceTree tree = test::litTree(device(), voxels, 3);
    test::setNormals(device(), tree, test::kObliqueNormals);
    return tree;
}

// A mean of the hemisphere about any normal makes no light and loses none: a white body looks like the sky, in each way
// of finding light.
TEST(PathNormals, AWhiteBodyCannotBeSeen)
{
    const DeviceTree tree = obliqueBody();
    DeviceEnvironment sky = constantSky({0.5F, 1.0F, 2.0F});
    EXPECT_LT(pictureOf(tree, sky, outside(), 16, 1, {.bounces = 0, .smooth = true}).mean.g, 0.95) << "it is there";
    for (const LightSampling way : kWays)
    {
        const PathPicture picture =
            pictureOf(tree, sky, outside(), 16, 48, {.bounces = 12, .sampling = way, .smooth = true});
        const double tolerance = 0.001 + (way == LightSampling::Chance ? 0.0 : 3.0 * picture.error);
        EXPECT_NEAR(picture.luminance, luminanceOf({0.5, 1.0, 2.0}), tolerance);
        EXPECT_LT(picture.error, 0.004);
    }
}

// Nor does light leak through walls of one voxel, however their normals and those of the body lean: inside of black
// walls that glow all is as bright as they are, whatever is outside.
TEST(PathNormals, NoLightComesThroughWalls)
{
    DeviceEnvironment sky = constantSky(glm::vec3(64.0F));
    const ViewCamera inside = ViewCamera::lookAt({6.5, 6.2, 6.7}, {3.0, 2.0, 3.0}, 1.3);
    for (const LightSampling way : {LightSampling::Both, LightSampling::Chance})
    {
        const DeviceTree tree = obliqueBody(test::roomOf({{}, glm::uvec3(0), glm::vec3(1.0F)}, 8));
        const PathPicture picture =
            pictureOf(tree, sky, inside, 16, 32, {.bounces = 8, .sampling = way, .smooth = true});
        EXPECT_NEAR(picture.luminance, 1.0, 0.001 + 3.0 * picture.error);
        EXPECT_LT(picture.error, 0.003);
    }
}

// A slope of steps, for whose faces the sun is partly behind the horizon, is as bright as the plane.
TEST(PathNormals, ASlopeOfStepsIsLitLikeAPlane)
{
    const LitVoxel grey = {{}, glm::uvec3(188), glm::vec3(0.0F)};
    std::vector<LitVoxel> voxels;
    for (std::uint32_t x = 0; x < 16; ++x)
    {
        test::addBox(voxels, {x, 0, 0}, {x + 1, 16 - x, 16}, grey);
    }
    DeviceTree tree = test::litTree(device(), voxels, 4);
    test::setNormals(device(), tree, std::array<gpu::uint, 1>{0x3FFF4000U}); // (1, 1, 0)
    DeviceEnvironment sky = constantSky(glm::vec3(0.0F));
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(1.0, -0.3, 0.2));
    sky.setSun({.direction = to_sun, .irradiance = glm::dvec3(2.0, 3.0, 4.0)});
    const ViewCamera view = ViewCamera::lookAt({28.0, 31.0, 9.0}, {8.0, 8.0, 8.0}, 0.1);
    const double cosine = glm::dot(to_sun, glm::normalize(glm::dvec3(1.0, 1.0, 0.0)));
    const glm::dvec3 expected = test::albedoOf(grey) * cosine * glm::dvec3(2.0, 3.0, 4.0);
    const PathPicture picture = pictureOf(tree, sky, view, 8, 64, {.bounces = 1, .smooth = true});
    for (const glm::dvec3& pixel : picture.pixels)
    {
        EXPECT_LT(glm::length(pixel - expected), 0.02 * glm::length(expected));
    }
}

// In uneven light from outside, by a lamp and a sun, all ways of finding light agree.
TEST(PathNormals, LightIsTheSameInEachWay)
{
    std::vector<LitVoxel> lamp;
    test::addBox(lamp, {6, 6, 3}, {8, 7, 5}, {{}, glm::uvec3(128), {1.5F, 1.25F, 0.5F}});
    const DeviceTree tree = obliqueBody(lamp);
    DeviceEnvironment sky(device().device());
    sky.setSun({.direction = {0.5, 1.0, 0.7}, .irradiance = glm::dvec3(0.7), .angle = 0.2});
    std::array<PathPicture, kWays.size()> pictures;
    for (std::size_t i = 0; i < kWays.size(); ++i)
    {
        pictures.at(i) = pictureOf(tree, sky, outside(), 16, kWays.at(i) == LightSampling::Both ? 80 : 320,
                                   {.bounces = 2, .sampling = kWays.at(i), .smooth = true});
        const double error = std::hypot(pictures.at(i).error, pictures.front().error);
        EXPECT_NEAR(pictures.at(i).luminance, pictures.front().luminance, 3.0 * error);
        EXPECT_LT(error, 0.01 * pictures.front().luminance);
    }
}

} // namespace
} // namespace zvo
