// SPDX-License-Identifier: MIT
// The radiance cache against known answers.
#include "core/scene/camera.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/radiance_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace zvo
{
namespace
{

using test::constantSky;
using test::device;
using test::facesOf;
using test::LitVoxel;
using test::PathPicture;
using test::pictureOf;
using test::runFrames;
using test::settledPicture;
using test::whiteVoxel;

ViewCamera outside()
{
    return ViewCamera::lookAt({19.0, 15.0, 23.0}, {4.0, 4.0, 4.0}, 0.4);
}

// A convex body of albedo 1 in a constant sky looks like the sky.
TEST(RadianceFurnace, AWhiteCubeCannotBeSeen)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {2, 2, 2}, {6, 6, 6}, whiteVoxel());
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = constantSky({0.5F, 1.0F, 2.0F});
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, tree, sky, outside(), 64, 1024, 8);
    const auto faces = facesOf(tracer.cache());
    ASSERT_EQ(faces.size(), 3U * 16U);
    glm::dvec3 mean(0.0);
    for (const auto& [name, face] : faces)
    {
        mean += face.radiance / static_cast<double>(faces.size());
        EXPECT_NEAR(face.radiance.g, 1.0, 0.01);
    }
    EXPECT_NEAR(mean.r, 0.5, 0.0005);
    EXPECT_NEAR(mean.g, 1.0, 0.001);
    EXPECT_NEAR(mean.b, 2.0, 0.002);
    for (const glm::dvec3& pixel : picture.pixels)
    {
        EXPECT_NEAR(pixel.g, 1.0, 0.01);
    }
}

// Light by normals is a mean of that of faces, so bodies look like the sky by it, too, wherever their normals point.
TEST(RadianceFurnace, AWhiteBodyCannotBeSeenByItsNormals)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {2, 2, 2}, {6, 3, 6}, whiteVoxel());
    test::addBox(voxels, {2, 3, 2}, {4, 4, 6}, whiteVoxel());
    DeviceTree tree = test::litTree(device(), voxels, 3);
    test::setNormals(device(), tree, test::kObliqueNormals);
    DeviceEnvironment sky = constantSky({0.5F, 1.0F, 2.0F});
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, tree, sky, outside(), 64, 512, 8, {}, CacheView::Smooth);
    EXPECT_NEAR(picture.luminance, test::luminanceOf({0.5, 1.0, 2.0}), 0.01);
    for (const glm::dvec3& pixel : picture.pixels)
    {
        EXPECT_NEAR(pixel.g, 1.0, 0.05);
    }
}

// It looks nearly like the sky through cones, too.
TEST(RadianceFurnace, AWhiteCubeCanHardlyBeSeenThroughCones)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {2, 2, 2}, {6, 6, 6}, whiteVoxel());
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = constantSky({0.5F, 1.0F, 2.0F});
    FrameRenderer tracer(device().device());
    tracer.resize(64, 64);
    runFrames(tracer, tree, sky, outside(), 64, {});
    tracer.beginPicture(test::cachedOptions());
    const TraceCamera camera = traceCamera(outside(), tree.grid, 64);
    device().run(
        [&](vk::FrameGraph& graph) {
            tracer.addSample(graph, {tree, camera, &sky}, test::cachedOptions({}, CacheView::Cones));
        });
    const PathPicture picture = pictureOf(tracer);
    EXPECT_NEAR(picture.luminance, test::luminanceOf({0.5, 1.0, 2.0}), 0.02);
}

// So does a body with holes, by many bounces.
TEST(RadianceFurnace, AWhiteBowlCannotBeSeen)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {8, 1, 8}, whiteVoxel());
    test::addBox(voxels, {0, 1, 0}, {1, 6, 8}, whiteVoxel());
    test::addBox(voxels, {1, 1, 0}, {8, 4, 1}, whiteVoxel());
    test::addBox(voxels, {3, 1, 3}, {5, 3, 5}, whiteVoxel());
    const DeviceTree tree = test::litTree(device(), voxels, 3);
    DeviceEnvironment sky = constantSky(glm::vec3(1.0F));
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, tree, sky, outside(), 64, 512, 8);
    EXPECT_NEAR(picture.luminance, 1.0, 0.005);
    for (const glm::dvec3& pixel : picture.pixels)
    {
        EXPECT_NEAR(pixel.g, 1.0, 0.05);
    }
}

// In a closed room whose walls glow, all bounces add up to the sum of a geometric series.
TEST(RadianceFurnace, AGlowingRoomHasTheLightOfAllBounces)
{
    const LitVoxel wall = {{}, glm::uvec3(188), glm::vec3(0.5F)};
    const DeviceTree tree = test::litTree(device(), test::roomOf(wall, 8), 3);
    DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
    const ViewCamera inside = ViewCamera::lookAt({4.2, 4.1, 4.3}, {1.0, 2.0, 3.0}, 1.0);
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, tree, dark, inside, 64, 256, 8);
    const double expected = 0.5 / (1.0 - test::albedoOf(wall).r);
    EXPECT_NEAR(picture.luminance, expected, 0.005 * expected);
}

// In the first frame no face keeps light that others could reflect. A path that hits one goes on, so light of two
// bounces arrives.
TEST(RadianceFurnace, TheFirstFrameHasTwoBounces)
{
    const LitVoxel wall = {{}, glm::uvec3(188), glm::vec3(0.5F)};
    const DeviceTree tree = test::litTree(device(), test::roomOf(wall, 32), 5);
    DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
    const ViewCamera inside = ViewCamera::lookAt({16.2, 16.1, 16.3}, {1.0, 2.0, 3.0}, 1.5);
    FrameRenderer tracer(device().device());
    tracer.resize(128, 128);
    runFrames(tracer, tree, dark, inside, 1, {});
    double mean = 0.0;
    std::uint32_t count = 0;
    for (const auto& [name, face] : facesOf(tracer.cache()))
    {
        if (face.samples != 0)
        {
            mean += face.radiance.r;
            ++count;
        }
    }
    ASSERT_GT(count, 500U);
    const double expected = 0.5 * (1.0 + test::albedoOf(wall).r);
    EXPECT_NEAR(mean / count, expected, 0.02 * expected);
}

// In the second frame a camera looks the other way. Of the faces that paths from there hit, an eighth are without light
// beside faces that were sampled in the first frame. If they reflected none of that light, the mean would be 0.76, and
// if they reflected it twice, 0.86.
TEST(RadianceFurnace, FacesWithoutLightReflectThatBesideThem)
{
    const LitVoxel wall = {{}, glm::uvec3(188), glm::vec3(0.5F)};
    const DeviceTree tree = test::litTree(device(), test::roomOf(wall, 32), 5);
    DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
    FrameRenderer tracer(device().device());
    tracer.resize(36, 36);
    runFrames(tracer, tree, dark, ViewCamera::lookAt({16.2, 16.1, 16.3}, {1.0, 2.0, 3.0}, 2.2), 1, {});
    const auto before = facesOf(tracer.cache());
    const auto bricks = facesOf(tracer.cache(), 1);
    runFrames(tracer, tree, dark, ViewCamera::lookAt({16.2, 16.1, 16.3}, {31.0, 30.0, 29.0}, 2.2), 1, {});
    double mean = 0.0;
    std::uint32_t count = 0;
    for (const auto& [name, face] : facesOf(tracer.cache()))
    {
        const test::FaceName& place = name; // clang 14 captures no structured binding
        const auto found = before.find(place);
        const bool is_new = found == before.end() || found->second.samples == 0;
        // Without a brick that has light, a face shows its own.
        const bool is_alone = std::ranges::none_of(
            bricks,
            [&](const auto& brick)
            {
                return brick.first.normal == place.normal &&
                       glm::all(glm::lessThanEqual(glm::abs(glm::ivec3(brick.first.cell) - glm::ivec3(place.cell / 4U)),
                                                   glm::ivec3(1)));
            });
        if (face.samples == 1 && is_new && is_alone)
        {
            mean += face.radiance.r;
            ++count;
        }
    }
    ASSERT_GT(count, 1000U);
    EXPECT_NEAR(mean / count, 0.81, 0.02);
}

// A wall of one voxel keeps all light of a lamp behind it, on its faces and in the picture.
TEST(RadianceWalls, NoLightComesThrough)
{
    std::vector<LitVoxel> voxels = test::roomOf(whiteVoxel(), 8);
    test::addBox(voxels, {3, 3, 3}, {5, 5, 5}, LitVoxel{{}, glm::uvec3(0), glm::vec3(1.5F, 1.0F, 0.5F)});
    // Faces outside of the room that see its walls and each other.
    test::addBox(voxels, {10, 0, 0}, {11, 8, 8}, whiteVoxel());
    const DeviceTree tree = test::litTree(device(), voxels, 4);
    DeviceEnvironment dark = constantSky(glm::vec3(0.0F));
    const ViewCamera beside = ViewCamera::lookAt({9.5, 14.0, 25.0}, {9.0, 4.0, 4.0}, 0.8);
    FrameRenderer tracer(device().device());
    const PathPicture picture = settledPicture(tracer, tree, dark, beside, 64, 64, 4);
    EXPECT_EQ(picture.mean, glm::dvec3(0.0));
    const auto faces = facesOf(tracer.cache());
    EXPECT_GT(faces.size(), 200U);
    for (const auto& [name, face] : faces)
    {
        EXPECT_EQ(face.radiance, glm::dvec3(0.0));
    }
}

} // namespace
} // namespace zvo
