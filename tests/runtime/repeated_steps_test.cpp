// SPDX-License-Identifier: MIT
// Recording a step of a build fails half way. The commands that were recorded reach the device, and the step is
// repeated. The result equals a build without failures. The failures are in making kernels, one by one, because kernels
// are made between passes.
#include "core/base/kernels.h"
#include "core/base/step_job.h"
#include "core/file/zvo_file.h"
#include "core/octree/octree_builder.h"
#include "core/svdag/svdag_builder.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/failing_vulkan.h"
#include "support/materials_scene.h"
#include "support/zvo_parts.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

// Records the steps of a build. Returns the number of recordings that failed.
std::uint32_t takeSteps(vk::HeadlessDevice& device, StepJob& builder)
{
    std::uint32_t failures = 0;
    while (!builder.isDone())
    {
        bool has_failed = false;
        std::vector<vk::PassTime> passes = device.run(
            [&](vk::FrameGraph& graph)
            {
                try
                {
                    builder.record(graph);
                }
                catch (const Error& error)
                {
                    EXPECT_EQ(error.code(), ErrorCode::Memory) << error.what();
                    has_failed = true;
                }
            });
        failures += has_failed ? 1 : 0;
        if (!has_failed)
        {
            builder.resume(std::move(passes));
        }
    }
    return failures;
}

struct Outcome
{
    std::string octree;
    std::string dag; // empty if a step of the octree has failed
    std::uint32_t failures = 0;
};

// Builds and compresses on a new device, whose kernel with this number cannot be made at first.
Outcome outcome(const Scene& scene, const Grid& grid, std::uint64_t failing_kernel)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.get_instance_proc_addr = test::failingVulkan();
    vk::HeadlessDevice device(options, zvoKernels());
    const GpuScene uploaded = uploadScene(device, scene, true);
    test::failCallOf("vkCreateComputePipelines", failing_kernel);
    Outcome result;
    OctreeBuilder octree(device.device(), uploaded, grid, {Coverage::Thin, true, {}});
    result.failures += takeSteps(device, octree);
    DeviceTree built = octree.take().octree;
    result.octree = test::zvoSha256(downloadTree(device, built));
    if (result.failures != 0)
    {
        return result;
    }
    SvdagBuilder dag(device.device(), std::move(built), {});
    result.failures += takeSteps(device, dag);
    result.dag = test::zvoSha256(downloadTree(device, dag.take().dag));
    return result;
}

TEST(RepeatedSteps, GiveTheSameBytes)
{
    Scene scene = test::materialsScene(10.0F, 20);
    Grid grid = Grid::around(scene.bounds(), 6);
    grid.depth = 13; // the scene lies in a corner; the brick table has keys of 64 bits, which leave the least room
    const Outcome expected = outcome(scene, grid, UINT64_MAX);
    ASSERT_EQ(expected.failures, 0U);
    constexpr std::uint64_t kStep = 5; // making a device takes time; 15 is one of the kernels that number nodes
    std::uint64_t number = 0;
    for (std::uint32_t failures = 1; failures == 1; number += kStep)
    {
        const Outcome repeated = outcome(scene, grid, number);
        failures = repeated.failures;
        EXPECT_EQ(repeated.octree, expected.octree) << "kernel " << number;
        EXPECT_TRUE(repeated.dag.empty() || repeated.dag == expected.dag) << "kernel " << number;
    }
    EXPECT_GT(number, 20U);

    for (Material& material : scene.materials)
    {
        material.emission = glm::vec3(0.0F); // so that sums are kept of mixed voxels alone
    }
    const std::string dark = outcome(scene, grid, UINT64_MAX).octree;
    for (std::uint64_t kernel = 4; kernel < 16; kernel += 2) // those that cover bricks, and number them
    {
        const Outcome repeated = outcome(scene, grid, kernel);
        EXPECT_EQ(repeated.octree, dark) << "kernel " << kernel;
        EXPECT_EQ(repeated.failures, 1U);
    }
}

} // namespace

} // namespace zvo
