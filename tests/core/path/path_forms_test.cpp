// SPDX-License-Identifier: MIT
// Both forms of path tracing, stages and one kernel, make the same pictures bit for bit.
#include "core/path/path_tracer.h"
#include "core/upload/gpu_scene.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/same_bytes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::LitVoxel;
using test::sameBytes;

/// What a form makes of a number of samples.
struct FormPicture
{
    std::vector<gpu::PixelSum> sums;
    std::vector<gpu::PixelFeatures> features; // where they are asked for
    std::uint64_t ray_count = 0;              // of the last sample
    std::uint32_t capped_rays = 0;
    std::uint64_t bytes = 0;

    friend bool operator==(const FormPicture& a, const FormPicture& b)
    {
        return a.ray_count == b.ray_count && sameBytes(a.sums, b.sums) && sameBytes(a.features, b.features);
    }
};

/// What a picture shows, in which size.
struct Motif
{
    const DeviceTree& tree;
    DeviceEnvironment& light;
    ViewCamera view;
    std::uint32_t width = 19;
    std::uint32_t height = 13;
};

FormPicture trace(const Motif& motif, PathForm form, const PathOptions& options, std::uint32_t samples = 2)
{
    PathTracer tracer(device().device());
    tracer.resize(motif.width, motif.height, form);
    const TraceCamera camera = traceCamera(motif.view, motif.tree.grid, motif.height);
    vk::BufferOf<gpu::DispatchArgs> lists(device().device(), "lists", tracer.listElements(options));
    for (std::uint32_t i = 0; i < samples; ++i)
    {
        device().run([&](vk::FrameGraph& graph)
                     { tracer.addSample(graph, motif.tree, motif.light, camera, options, &lists); });
    }
    FormPicture picture = {device().download(tracer.picture().sums),
                           {},
                           rayCountOf(device().download(lists)),
                           device().download(tracer.status()).front().capped_rays,
                           tracer.bytes()};
    if (options.features)
    {
        picture.features = device().download(tracer.guided().features);
    }
    return picture;
}

bool isLit(const FormPicture& picture)
{
    double sum = 0.0;
    for (const gpu::PixelSum& pixel : picture.sums)
    {
        sum += double{pixel.luminance_squared};
    }
    return sum > 0.0;
}

void expectSame(const Motif& motif, PathOptions options)
{
    const FormPicture plain = trace(motif, PathForm::OneKernel, options);
    options.features = true;
    const FormPicture stages = trace(motif, PathForm::Stages, options);
    const FormPicture kernel = trace(motif, PathForm::OneKernel, options);
    EXPECT_TRUE(isLit(stages));
    EXPECT_TRUE(kernel == stages);
    EXPECT_TRUE(sameBytes(plain.sums, stages.sums));
    EXPECT_EQ(kernel.capped_rays, 0U);
}

// A room that is open to one side.
std::vector<LitVoxel> openRoom(const glm::vec3& emission)
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {8, 1, 8}, {{}, glm::uvec3(188), glm::vec3(0.0F)});
    test::addBox(voxels, {0, 1, 0}, {1, 6, 8}, {{}, {220, 60, 40}, glm::vec3(0.0F)});
    test::addBox(voxels, {1, 1, 0}, {7, 6, 1}, {{}, {60, 200, 40}, glm::vec3(0.0F)});
    test::addBox(voxels, {3, 1, 3}, {5, 3, 5}, {{}, glm::uvec3(255), glm::vec3(0.0F)});
    test::addBox(voxels, {2, 5, 3}, {4, 6, 4}, {{}, glm::uvec3(128), emission});
    test::addBox(voxels, {6, 2, 2}, {7, 3, 3}, {{}, glm::uvec3(128), emission});
    return voxels;
}

ViewCamera intoTheOpenRoom()
{
    return ViewCamera::lookAt({4.3, 4.5, 16.0}, {4.0, 2.6, 3.0}, 0.65);
}

DeviceEnvironment skyWithSun()
{
    DeviceEnvironment sky(device().device());
    sky.setSun({.direction = {0.5, 1.0, 0.7}, .irradiance = glm::dvec3(1.5), .angle = 0.1});
    return sky;
}

TEST(PathForms, AreTheSameInEveryWayOfFindingLight)
{
    const DeviceTree tree = test::litTree(device(), openRoom({1.5F, 1.25F, 0.5F}), 3);
    DeviceEnvironment sky = skyWithSun();
    for (const LightSampling sampling : {LightSampling::Both, LightSampling::Chance, LightSampling::Lights})
    {
        for (const bool by_power : {false, true})
        {
            for (const bool roulette : {false, true})
            {
                SCOPED_TRACE(testing::Message() << static_cast<int>(sampling) << by_power << roulette);
                expectSame(
                    {tree, sky, intoTheOpenRoom()},
                    {.bounces = 5, .seed = 7, .sampling = sampling, .lights_by_power = by_power, .roulette = roulette});
            }
        }
    }
}

TEST(PathForms, AreTheSameByNormals)
{
    DeviceTree tree = test::litTree(device(), openRoom({1.5F, 1.25F, 0.5F}), 3);
    test::setNormals(device(), tree, test::kObliqueNormals);
    DeviceEnvironment sky = skyWithSun();
    const PathOptions options = {.bounces = 3, .smooth = true, .features = true};
    const FormPicture stages = trace({tree, sky, intoTheOpenRoom()}, PathForm::Stages, options);
    EXPECT_TRUE(isLit(stages));
    EXPECT_TRUE(trace({tree, sky, intoTheOpenRoom()}, PathForm::OneKernel, options) == stages);
}

TEST(PathForms, AreTheSameForAnyNumberOfBounces)
{
    const DeviceTree tree = test::litTree(device(), openRoom({1.5F, 1.25F, 0.5F}), 3);
    DeviceEnvironment sky = skyWithSun();
    for (const std::uint32_t bounces : {0U, 1U, 3U, 40U})
    {
        expectSame({tree, sky, intoTheOpenRoom()}, {.bounces = bounces});
    }
}

TEST(PathForms, AreTheSameThroughEveryCamera)
{
    const DeviceTree tree = test::litTree(device(), openRoom({1.5F, 1.25F, 0.5F}), 3);
    DeviceEnvironment sky = skyWithSun();
    expectSame({tree, sky, intoTheOpenRoom()}, {.bounces = 2, .lens_radius = 0.5F, .focus_distance = 11.0F});
    ViewCamera orthographic = intoTheOpenRoom();
    orthographic.orthographic = true;
    orthographic.half_height = 5.0;
    expectSame({tree, sky, orthographic}, {.bounces = 2});
    expectSame({tree, sky, orthographic}, {.bounces = 2, .lens_radius = 0.5F, .focus_distance = 11.0F});
    expectSame({tree, sky, ViewCamera::lookAt({6.5, 2.5, 2.5}, {0, 0, 0}, 0.7)}, {.bounces = 2}); // in a lamp
}

TEST(PathForms, AreTheSameWithoutEmissionAttributesOrVoxels)
{
    DeviceEnvironment sky = skyWithSun();
    const DeviceTree dark = test::litTree(device(), openRoom(glm::vec3(0.0F)), 3);
    expectSame({dark, sky, intoTheOpenRoom()}, {.bounces = 3});
    const Scene scene = test::randomTriangles(5, 40, 16.0F);
    const Grid grid = {.origin = glm::vec3(0.0F), .voxel_size = 0.5F, .depth = 5};
    BuildOptions geometry;
    geometry.attributes = false;
    const DeviceTree plain = buildOctree(device(), uploadScene(device(), scene, false, 1.0F), grid, geometry).octree;
    ASSERT_FALSE(plain.hasAttributes());
    expectSame({plain, sky, ViewCamera::lookAt({30.0, 22.0, 35.0}, {8.0, 8.0, 8.0}, 0.7)}, {.bounces = 3});
    DeviceTree empty;
    empty.grid.depth = 4;
    expectSame({empty, sky, ViewCamera::lookAt({20, 20, 20}, {0, 0, 0}, 0.7)}, {});
}

// More pixels than one dispatch takes.
TEST(PathForms, AreTheSameInPicturesOfSeveralDispatches)
{
    const DeviceTree tree = test::litTree(device(), openRoom({1.5F, 1.25F, 0.5F}), 3);
    DeviceEnvironment sky = skyWithSun();
    const Motif motif = {tree, sky, ViewCamera::lookAt({4.3, 4.5, 60.0}, {4.0, 2.6, 3.0}, 0.65), 410, 390};
    const PathOptions options = {.bounces = 64, .sampling = LightSampling::Chance};
    EXPECT_EQ(trace(motif, PathForm::OneKernel, options, 1), trace(motif, PathForm::Stages, options, 1));
}

// A device that ends loops early loses paths, but not unnoticed.
TEST(PathForms, WhatIsLostIsCounted)
{
    const DeviceTree tree = test::litTree(device(), test::roomOf({{}, glm::uvec3(255), glm::vec3(0.5F)}, 32), 5);
    DeviceEnvironment sky = skyWithSun();
    const Motif motif = {tree, sky, ViewCamera::lookAt({16.2, 16.1, 16.3}, {1.0, 2.0, 3.0}, 1.0), 8, 8};
    const FormPicture stages = trace(motif, PathForm::Stages, {.bounces = kBouncesMax}, 1);
    const FormPicture kernel = trace(motif, PathForm::OneKernel, {.bounces = kBouncesMax}, 1);
    EXPECT_EQ(stages.capped_rays, 0U);
    EXPECT_TRUE(kernel == stages || kernel.capped_rays != 0);
}

TEST(PathForms, OneKernelNeedsNoLists)
{
    const DeviceTree tree = test::litTree(device(), openRoom(glm::vec3(0.0F)), 3);
    DeviceEnvironment sky = skyWithSun();
    const Motif motif = {tree, sky, intoTheOpenRoom(), 200, 100};
    const std::uint64_t pixels = 200 * 100;
    EXPECT_LT(trace(motif, PathForm::OneKernel, {.bounces = 0}, 1).bytes, pixels * sizeof(gpu::PixelSum) + 4096);
    EXPECT_GT(trace(motif, PathForm::Stages, {.bounces = 0}, 1).bytes, pixels * (sizeof(gpu::PixelSum) + 200));
}

TEST(PathForms, AreChosenByTheDevice)
{
    const auto formOn = [](const char* type, const vk::TuningValues& tuning)
    {
        vk::HeadlessOptions options = test::deviceOptions();
        options.overrides.type = type;
        options.tuning = tuning;
        vk::HeadlessDevice chosen(options, zvoKernels());
        return pathFormOn(chosen.device());
    };
    EXPECT_EQ(formOn("cpu", {}), PathForm::Stages);
    EXPECT_EQ(formOn("discrete", {}), PathForm::OneKernel);
    EXPECT_EQ(formOn("integrated", {}), PathForm::OneKernel);
    EXPECT_EQ(formOn("cpu", {{"path-form", 1}}), PathForm::OneKernel);
}

} // namespace
} // namespace zvo
