// SPDX-License-Identifier: MIT
// Vulkan calls of a small run fail. Each gives a clear error and leaves nothing behind. On a new device every seventh
// call fails (every one in scripts/check-sanitizers), on a device that is used further every one.
#include "core/base/kernels.h"
#include "core/deform/dynamic_object.h"
#include "core/file/zvo_file.h"
#include "core/scene/animation.h"
#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "runtime/octree_sha256.h"
#include "runtime/tiled_build.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/failing_vulkan.h"
#include "support/materials_scene.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/sweep.h"
#include "support/zvo_parts.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

/// The input of a run: one that uses everything, or a small one for new devices.
struct Job
{
    Scene scene;
    bool attributes;
    VoxelizeCapacities capacities;
};

Job smallJob()
{
    return {test::sphereScene(glm::vec3(0.0F), 1.0F, 6), false, {1 << 7, 1 << 6, 1 << 7, 1 << 10, 1}};
}

Job wholeJob()
{
    Scene scene = test::materialsScene(10.0F);
    scene.primitives[0].morph_targets = {{scene.primitives[0].positions, {}}};
    return {std::move(scene), true, {64, 1, 1 << 10}}; // grows once
}

/// Returns the digest of the octree of gpu_scene, made of scene, after it has moved and been deformed, if it has morph
/// targets.
std::string workOnADynamicObject(vk::HeadlessDevice& device, const Scene& scene, const GpuScene& gpu_scene,
                                 const Grid& grid)
{
    Pose pose = poseAt(scene, 0.0);
    pose.transforms[1][3].x += 1.0F;
    pose.morph_weights[0][0] = 0.25F;
    const DeformMesh mesh = uploadDeformMesh(device, scene);
    DynamicObjectBuffers object = makeDynamicObject(device, planDynamicObject(scene, mesh), gpu_scene, mesh);
    device.run([&](vk::FrameGraph& graph) { setPose(graph, mesh, pose, object); });
    const BuildResult built = buildOctree(device, {gpu_scene, object}, grid, {Coverage::Thin, false, {}});
    return octreeSha256(device, built.octree);
}

/// Uploads, builds, traces and downloads. Returns the octree's digest and the picture; for a whole job also a dynamic
/// object's digest.
std::string work(vk::HeadlessDevice& device, const Job& job)
{
    constexpr std::uint32_t kEdge = 24;
    const std::uint64_t used_before = device.device().memory().usedBytes();
    std::string result;
    try
    {
        const GpuScene gpu_scene = uploadScene(device, job.scene, job.attributes);
        const Grid grid = Grid::around(job.scene.bounds(), 4);
        const DeviceTree octree =
            buildOctree(device, gpu_scene, grid, {Coverage::Thin, job.attributes, job.capacities}).octree;
        TraceOptions options;
        options.shadows = job.attributes;
        const TraceCamera camera = traceCamera(ViewCamera::framing(job.scene.bounds(), 1.0), grid, kEdge);
        const test::Picture picture = test::takePicture(device, octree, camera, kEdge, kEdge, options);
        result = octreeSha256(device, octree);
        for (const gpu::uint pixel : picture.image)
        {
            result += fmt::format(" {:x}", pixel);
        }
        if (job.attributes)
        {
            result += workOnADynamicObject(device, job.scene, gpu_scene, grid);
        }
    }
    catch (...)
    {
        EXPECT_EQ(device.device().memory().usedBytes(), used_before) << "after " << test::failedFunction();
        throw;
    }
    EXPECT_EQ(device.device().memory().usedBytes(), used_before);
    return result;
}

/// Builds, compresses with tables that grow, packs and downloads a DAG.
TreeData makeDag(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid)
{
    BuildResult built = buildOctree(device, scene, grid, {});
    DeviceTree dag = compress(device, std::move(built.octree), {.table_slots = 64}).dag;
    packTree(device, AttributeFormat::Blocks, dag);
    return downloadTree(device, dag);
}

vk::HeadlessOptions options()
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.get_instance_proc_addr = test::failingVulkan();
    options.slices.submission_ms = 0; // the same calls in every run, even on a busy machine
    return options;
}

std::string workOnANewDevice()
{
    vk::HeadlessDevice device(options(), zvoKernels());
    return work(device, smallJob());
}

/// The result of a run without failures, and the number of calls that can fail in it.
class FailingCalls : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        test::failCall(UINT64_MAX);
        s_expected = workOnANewDevice();
        s_call_count = test::fallibleCallCount();
    }

    // Returns the error's code, or nothing if the run succeeded.
    static std::optional<ErrorCode> errorOf(const std::function<std::string()>& run, const std::string& expected)
    {
        try
        {
            EXPECT_EQ(run(), expected) << "in spite of " << test::failedFunction();
        }
        catch (const Error& error)
        {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            return error.code();
        }
        return std::nullopt;
    }

    // Calls at the end of a device or a buffer, whose failures a run does not notice.
    static bool isOfTheEnd(const std::string& function)
    {
        return function == "vkGetPipelineCacheData" || function == "vkDeviceWaitIdle" ||
               function == "vkFreeDescriptorSets"; // which Vulkan lets no driver fail
    }

    static void expectCode(const std::optional<ErrorCode>& code, VkResult result)
    {
        const std::string function = test::failedFunction();
        if (!code)
        {
            // The run succeeds without names and one of two messengers; memory may come from another type.
            EXPECT_TRUE(isOfTheEnd(function) || function == "vkSetDebugUtilsObjectNameEXT" ||
                        function == "vkCreateDebugUtilsMessengerEXT" || function == "vkAllocateMemory")
                << function << " failed and nobody noticed";
            return;
        }
        const bool memory = result != VK_ERROR_DEVICE_LOST;
        const ErrorCode other = function == "vkCreateInstance" ? ErrorCode::Device : ErrorCode::Other;
        EXPECT_EQ(*code, memory ? ErrorCode::Memory : other) << function;
    }

    static std::vector<std::string> sortedLiveObjects()
    {
        std::vector<std::string> objects = test::liveObjects();
        std::sort(objects.begin(), objects.end());
        return objects;
    }

    // Runs once for each call, which fails, and sometimes, as well as at the end, without failures. No run leaves an
    // object.
    static void expectToResume(const std::function<std::string()>& run, std::uint64_t call_count_min)
    {
        constexpr std::uint64_t kWholeRunEach = 16;
        test::failCall(UINT64_MAX);
        const std::string expected = run(); // makes the kernels
        const std::vector<std::string> live = sortedLiveObjects();
        test::failCall(UINT64_MAX);
        EXPECT_EQ(run(), expected);
        const std::uint64_t call_count = test::fallibleCallCount();
        ASSERT_GT(call_count, call_count_min);
        test::Sweep sweep;
        std::uint64_t run_count = 0;
        for (std::uint64_t number = sweep.first(); number < call_count; number += sweep.step())
        {
            test::failCall(number, VK_ERROR_OUT_OF_HOST_MEMORY);
            expectCode(errorOf(run, expected), VK_ERROR_OUT_OF_HOST_MEMORY);
            ASSERT_EQ(sortedLiveObjects(), live) << "after " << test::failedFunction() << ", call " << number;
            if (run_count++ % kWholeRunEach == 0 || number + sweep.step() >= call_count)
            {
                test::failCall(UINT64_MAX);
                ASSERT_EQ(run(), expected) << "after call " << number;
            }
        }
    }

    static inline std::string s_expected;
    static inline std::uint64_t s_call_count = 0;
};

TEST_F(FailingCalls, TheRunHasManyCallsAndLeavesNothing)
{
    EXPECT_GT(s_call_count, 150U);
    EXPECT_TRUE(test::liveObjects().empty()) << test::liveObjects().front();
}

TEST_F(FailingCalls, EachOutOfDeviceMemoryIsAnErrorAndLeavesNothing)
{
    test::Sweep sweep(7); // making a device takes time
    std::uint64_t run_count = 0;
    std::uint64_t error_count = 0;
    for (std::uint64_t number = sweep.first(); number < s_call_count; number += sweep.step())
    {
        test::failCall(number, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        const std::optional<ErrorCode> code = errorOf(workOnANewDevice, s_expected);
        ASSERT_NE(test::failedFunction(), "") << "call " << number << " never came";
        expectCode(code, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        error_count += code ? 1 : 0;
        ++run_count;
        ASSERT_TRUE(test::liveObjects().empty())
            << test::liveObjects().front() << " leaked after " << test::failedFunction() << ", call " << number;
    }
    EXPECT_GT(error_count, run_count / 2);
    test::failCall(UINT64_MAX);
    EXPECT_EQ(workOnANewDevice(), s_expected);
}

TEST_F(FailingCalls, OtherResultsAndEverythingAfterThemToo)
{
    test::Sweep sweep(23);
    for (std::uint64_t number = sweep.first(); number < s_call_count; number += sweep.step())
    {
        for (const VkResult result : {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_DEVICE_LOST})
        {
            test::failCall(number, result);
            expectCode(errorOf(workOnANewDevice, s_expected), result);
            ASSERT_TRUE(test::liveObjects().empty()) << test::liveObjects().front() << " after call " << number;
        }
        test::failAllFrom(number, VK_ERROR_DEVICE_LOST);
        const bool failed = errorOf(workOnANewDevice, s_expected).has_value();
        EXPECT_TRUE(failed || isOfTheEnd(test::failedFunction())) << test::failedFunction() << ", call " << number;
        ASSERT_TRUE(test::liveObjects().empty()) << test::liveObjects().front() << " after call " << number;
    }
}

TEST_F(FailingCalls, ADeviceGoesOnAfterEveryOneOfThem)
{
    test::failCall(UINT64_MAX);
    vk::HeadlessDevice device(options(), zvoKernels());
    const Job job = wholeJob();
    expectToResume([&] { return work(device, job); }, 200);
}

TEST_F(FailingCalls, SoItDoesWhenItMakesDags)
{
    test::failCall(UINT64_MAX);
    vk::HeadlessDevice device(options(), zvoKernels());
    const Scene scene = test::materialsScene(10.0F);
    const GpuScene gpu_scene = uploadScene(device, scene, true);
    const Grid grid = Grid::around(scene.bounds(), 5);
    expectToResume([&] { return test::zvoSha256(makeDag(device, gpu_scene, grid)); }, 100);
}

// These tiles are too small to be split when memory is short, so that is an error.
TEST_F(FailingCalls, SoItDoesWhenItBuildsInTiles)
{
    test::failCall(UINT64_MAX);
    vk::HeadlessDevice device(options(), zvoKernels());
    const Scene scene = test::boxScene(glm::vec3(0.1F), glm::vec3(0.3F, 0.3F, 0.7F)); // in two tiles of eight
    const GpuScene gpu_scene = uploadScene(device, scene, true);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F / 32, .depth = 5};
    const TiledOptions tiled{.attributes = AttributeFormat::Blocks, .tile_depth = 4};
    expectToResume([&] { return test::zvoSha256(buildByTiles(device, gpu_scene, grid, tiled).tree); }, 200);
}

} // namespace
} // namespace zvo
