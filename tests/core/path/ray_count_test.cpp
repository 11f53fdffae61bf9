// SPDX-License-Identifier: MIT
// The rays of a sample, as the lists of its batches count them.
#include "core/path/path_tracer.h"

#include "core/light/environment.h"
#include "core/scene/camera.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::LitVoxel;

// A slab that fills the picture from above.
DeviceTree slab()
{
    std::vector<LitVoxel> voxels;
    test::addBox(voxels, {0, 0, 0}, {32, 1, 32}, {{}, glm::uvec3(188)});
    return test::litTree(device(), voxels, 5);
}

std::uint64_t raysOf(std::uint32_t width, std::uint32_t height, const glm::dvec3& sun, const PathOptions& options)
{
    const DeviceTree tree = slab();
    DeviceEnvironment light(device().device(), HdrImage{2, 1, std::vector(2, glm::vec3(0.0F))}, 0.0, 1.0);
    light.setSun({.direction = sun, .irradiance = glm::dvec3(1.0)});
    PathTracer tracer(device().device());
    tracer.resize(width, height);
    vk::BufferOf<gpu::DispatchArgs> lists(device().device(), "lists", tracer.listElements(options));
    const TraceCamera camera =
        traceCamera(ViewCamera::lookAt({16.0, 12.0, 16.0}, {16.0, 0.0, 16.0}, 0.6), tree.grid, height);
    device().run([&](vk::FrameGraph& graph) { tracer.addSample(graph, tree, light, camera, options, &lists); });
    return rayCountOf(device().download(lists));
}

TEST(RayCount, CountsRaysFromTheCameraOfBouncesAndToLights)
{
    constexpr std::uint64_t kPixels = 30ULL * 21;
    const glm::dvec3 above = {0.0, 1.0, 0.0};
    const glm::dvec3 below = {0.0, -1.0, 0.0};
    EXPECT_EQ(raysOf(30, 21, above, {.bounces = 0}), kPixels);
    EXPECT_EQ(raysOf(30, 21, above, {.bounces = 1}), 3 * kPixels) << "each hit has a bounce, and a ray to the sun";
    EXPECT_EQ(raysOf(30, 21, above, {.bounces = 5}), 3 * kPixels) << "no bounce hits anything";
    EXPECT_EQ(raysOf(30, 21, below, {.bounces = 1}), 2 * kPixels) << "the sun is behind all faces";
    EXPECT_EQ(raysOf(30, 21, above, {.bounces = 1, .sampling = LightSampling::Chance}), 2 * kPixels);
}

TEST(RayCount, CountsAllBatches)
{
    const glm::dvec3 above = {0.0, 1.0, 0.0};
    EXPECT_EQ(raysOf(1024, 513, above, {.bounces = 0}), 1024ULL * 513); // a row more than 524,288
}

} // namespace
} // namespace zvo
