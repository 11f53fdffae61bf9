// SPDX-License-Identifier: MIT
// What a picture shows beside its light: albedo, normal, depth and motion of places that the tests know.
#include "core/path/aov.h"
#include "core/path/path_tracer.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::LitVoxel;

constexpr std::uint32_t kWallWidth = 40;
constexpr std::uint32_t kWallHeight = 30;
constexpr std::uint32_t kSamples = 3;
constexpr glm::uvec3 kColor = {200, 120, 40};

// A wall at z = 4, towards +z.
DeviceTree wall()
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 3}, {16, 16, 4}, {{}, kColor});
    return test::litTree(device(), voxels, 4);
}

AovImages aovs(const DeviceTree& tree, const ViewCamera& view, const ViewCamera& before)
{
    DeviceEnvironment sky(device().device());
    PathTracer tracer(device().device());
    tracer.resize(kWallWidth, kWallHeight);
    const TraceCamera camera = traceCamera(view, tree.grid, kWallHeight);
    for (std::uint32_t i = 0; i < kSamples; ++i)
    {
        device().run([&](vk::FrameGraph& graph)
                     { tracer.addSample(graph, tree, sky, camera, {.bounces = 1, .features = true}); });
    }
    return aovsOf(device().download(tracer.guided().features), kWallWidth, kWallHeight, kSamples, tree.grid, camera,
                  traceCamera(before, tree.grid, kWallHeight));
}

// Where a camera sees a place, in pixels.
glm::dvec2 pixelOf(const ViewCamera& view, const glm::dvec3& place)
{
    const glm::dvec3 way = place - view.position;
    const double scale =
        view.orthographic ? view.half_height : std::tan(view.vertical_fov / 2) * glm::dot(way, view.forward);
    const double right = (glm::dot(way, view.right) / scale - view.shift.x) / view.pixel_aspect;
    const double up = glm::dot(way, view.up) / scale - view.shift.y;
    return {kWallWidth / 2.0 + kWallHeight / 2.0 * right - 0.5, kWallHeight / 2.0 - kWallHeight / 2.0 * up - 0.5};
}

// The place on the wall at the middle of a pixel.
glm::dvec3 placeOf(const ViewCamera& view, std::uint32_t x, std::uint32_t y)
{
    const double half = view.orthographic ? view.half_height : std::tan(view.vertical_fov / 2);
    const double right = (2.0 * x + 1.0 - kWallWidth) / kWallHeight * view.pixel_aspect + view.shift.x;
    const double down = (2.0 * y + 1.0 - kWallHeight) / kWallHeight - view.shift.y;
    const glm::dvec3 offset = half * (right * view.right - down * view.up);
    const glm::dvec3 origin = view.position + (view.orthographic ? offset : glm::dvec3(0));
    const glm::dvec3 direction = view.forward + (view.orthographic ? glm::dvec3(0) : offset);
    return origin + (4.0 - origin.z) / direction.z * direction;
}

TEST(PathFeatures, OfAWall)
{
    const DeviceTree tree = wall();
    for (const auto& [orthographic, is_plain] : {std::pair(false, true), {true, true}, {false, false}, {true, false}})
    {
        ViewCamera view = ViewCamera::lookAt({9.0, 7.0, 14.0}, {8.0, 8.0, 4.0}, 0.5);
        ViewCamera before = ViewCamera::lookAt({8.5, 6.0, 15.0}, {8.0, 8.5, 4.0}, 0.5);
        view.orthographic = before.orthographic = orthographic;
        view.half_height = before.half_height = 3.0;
        if (!is_plain)
        {
            view.shift = {0.4, -0.3};
            before.shift = {-0.2, 0.1};
            view.pixel_aspect = before.pixel_aspect = 1.2;
        }
        const AovImages images = aovs(tree, view, before);
        const glm::dvec3 albedo = test::albedoOf({{}, kColor});
        for (std::uint32_t i = 0; i < kWallWidth * kWallHeight; ++i)
        {
            const glm::dvec3 place = placeOf(view, i % kWallWidth, i / kWallWidth);
            EXPECT_LT(glm::distance(glm::dvec3(images.albedo[i]), albedo), 1e-5);
            EXPECT_LT(glm::distance(images.normal[i], glm::vec3(0, 0, 1)), 1e-5F);
            // Samples are anywhere in the pixel, whose edges are up to 0.2 units apart.
            EXPECT_NEAR(images.depth[i], glm::dot(place - view.position, view.forward), 0.05);
            const glm::dvec2 motion = pixelOf(before, place) - glm::dvec2(i % kWallWidth, i / kWallWidth);
            EXPECT_LT(glm::distance(glm::dvec2(images.motion[i]), motion), 0.1) << i;
        }
    }
}

TEST(PathFeatures, OfTheSky)
{
    const DeviceTree tree = wall();
    const ViewCamera view = ViewCamera::lookAt({8.0, 8.0, 14.0}, {8.0, 12.0, 30.0}, 0.5);
    const ViewCamera before = ViewCamera::lookAt({0.0, 3.0, 14.0}, {0.5, 7.0, 30.0}, 0.5); // the place does not matter
    const AovImages images = aovs(tree, view, before);
    ViewCamera from_here = before;
    from_here.position = view.position;
    for (std::uint32_t i = 0; i < kWallWidth * kWallHeight; ++i)
    {
        EXPECT_EQ(images.albedo[i], glm::vec3(0.0F));
        EXPECT_EQ(images.normal[i], glm::vec3(0.0F));
        EXPECT_EQ(images.depth[i], AovImages::kNoDepth);
        const glm::dvec3 place = placeOf(view, i % kWallWidth, i / kWallWidth);
        const glm::dvec3 ahead = view.position + (view.position - place);
        const glm::dvec2 motion = pixelOf(from_here, ahead) - glm::dvec2(i % kWallWidth, i / kWallWidth);
        EXPECT_LT(glm::distance(glm::dvec2(images.motion[i]), motion), 0.01);
    }
}

TEST(PathFeatures, PlacesBehindTheCameraBeforeHaveNoMotion)
{
    const DeviceTree tree = wall();
    const ViewCamera view = ViewCamera::lookAt({9.0, 7.0, 14.0}, {8.0, 8.0, 4.0}, 0.5);
    const AovImages images = aovs(tree, view, ViewCamera::lookAt({9.0, 7.0, 14.0}, {8.0, 8.0, 24.0}, 0.5));
    EXPECT_TRUE(std::ranges::all_of(images.motion,
                                    [](const glm::vec2& motion) { return motion == glm::vec2(AovImages::kNoMotion); }));
}

// Features change nothing of the picture, and a picture that has them begins anew.
TEST(PathFeatures, ThePictureIsTheSame)
{
    const DeviceTree tree = wall();
    DeviceEnvironment sky(device().device());
    const TraceCamera camera =
        traceCamera(ViewCamera::lookAt({9.0, 7.0, 14.0}, {8.0, 8.0, 4.0}, 0.5), tree.grid, kWallHeight);
    PathTracer tracer(device().device());
    tracer.resize(kWallWidth, kWallHeight);
    const auto sample = [&](bool features)
    {
        device().run([&](vk::FrameGraph& graph)
                     { tracer.addSample(graph, tree, sky, camera, {.bounces = 2, .features = features}); });
        std::vector<glm::vec3> pixels;
        for (const gpu::PixelSum& sum : device().download(tracer.picture().sums))
        {
            pixels.push_back(sum.radiance);
        }
        return pixels;
    };
    const std::vector<glm::vec3> plain = sample(false);
    EXPECT_EQ(sample(true), plain);
    EXPECT_EQ(tracer.sampleCount(), 1U);
}

} // namespace
} // namespace zvo
