// SPDX-License-Identifier: MIT
// A small lamp in a large dark hall: lights are found where there are few of them among many voxels.
#include "core/path/path_tracer.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/path_pictures.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace zvo
{
namespace
{

constexpr glm::vec3 kHall = {1000.0F, 300.0F, 500.0F}; // edges, in voxels

// A hall with pillars, and a lamp of 5 x 4 voxels below its ceiling.
Scene hallScene()
{
    constexpr float kWall = 0.5F; // planes run through the middles of voxels
    Scene scene = test::boxScene(glm::vec3(kWall), kHall - kWall);
    scene.materials.front().base_color = glm::vec4(0.5F, 0.5F, 0.5F, 1.0F);
    for (const float x : {250.5F, 500.5F, 750.5F})
    {
        Scene pillar = test::boxScene({x, kWall, 120.5F}, {x + 40.0F, kHall.y - kWall, 160.5F});
        pillar.materials = {scene.materials.front()};
        scene.append(std::move(pillar));
    }
    Scene lamp = test::triangleSoup({{800.1F, 240.5F, 300.1F},
                                     {804.9F, 240.5F, 300.1F},
                                     {804.9F, 240.5F, 303.9F},
                                     {800.1F, 240.5F, 300.1F},
                                     {804.9F, 240.5F, 303.9F},
                                     {800.1F, 240.5F, 303.9F}});
    lamp.materials.front().emission = glm::vec3(100.0F);
    scene.append(std::move(lamp));
    return scene;
}

double partWithLight(const test::PathPicture& picture)
{
    const auto count = std::ranges::count_if(picture.pixels, [](const glm::dvec3& pixel) { return pixel.g > 0.0; });
    return static_cast<double>(count) / static_cast<double>(picture.pixels.size());
}

TEST(PathHall, IsLitByALampOfTwentyVoxels)
{
    const Grid grid = {.depth = 10};
    const Scene scene = hallScene();
    const DeviceTree tree = buildOctree(test::device(), uploadScene(test::device(), scene, true), grid, {}).octree;
    EXPECT_GT(tree.voxel_count, 1'900'000U);
    EXPECT_EQ(tree.emission.count(), 20U);
    DeviceEnvironment dark = test::constantSky(glm::vec3(0.0F));
    const ViewCamera view = ViewCamera::lookAt({640.0, 150.0, 460.0}, {100.0, 110.0, 240.0}, 1.0);
    const auto picture = [&](std::uint32_t samples, LightSampling way) {
        return test::pictureOf(tree, dark, view, {48, 27}, samples, {.bounces = 2, .sampling = way});
    };
    // The lamp is behind the camera.
    const test::PathPicture few = picture(16, LightSampling::Both);
    const test::PathPicture many = picture(256, LightSampling::Both);
    const test::PathPicture chance = picture(16, LightSampling::Chance);
    EXPECT_LT(partWithLight(chance), 0.01) << "light is easily found";
    EXPECT_GT(partWithLight(many), 0.99) << "not all that is seen is lit";
    EXPECT_GT(partWithLight(few), 0.95);
    EXPECT_LT(many.error, 0.01 * many.luminance);
    EXPECT_NEAR(few.luminance, many.luminance, 0.1 * many.luminance);
}

} // namespace
} // namespace zvo
