// SPDX-License-Identifier: MIT
// Work that is split over many submissions gives the same bytes.
#include "core/base/kernels.h"
#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/materials_scene.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace zvo
{
namespace
{

/// All results of a run.
struct Made
{
    std::string sha;
    std::vector<gpu::uint> image;
    std::map<std::string, std::size_t> pass_counts; // by name
    std::uint32_t most_submissions = 0;             // in one call of run()
};

void count(std::map<std::string, std::size_t>& counts, const std::vector<vk::PassTime>& passes)
{
    for (const vk::PassTime& pass : passes)
    {
        ++counts[pass.name];
    }
}

Made make(const vk::SliceOptions& slices, const Scene& scene, std::uint32_t depth, const BuildOptions& options,
          int rounds = 1)
{
    vk::HeadlessOptions headless = test::deviceOptions();
    headless.slices = slices;
    vk::HeadlessDevice device(headless, zvoKernels());
    const GpuScene gpu_scene = uploadScene(device, scene, options.attributes);
    const Grid grid = Grid::around(scene.bounds(), depth);
    Made made;
    for (int round = 0; round < rounds; ++round) // the second round uses what was learned in the first
    {
        made = {};
        const BuildResult result = buildOctree(device, gpu_scene, grid, options);
        made.most_submissions = device.submissionCount();
        count(made.pass_counts, result.passes);
        made.sha = octreeSha256(device, result.octree);
        constexpr std::uint32_t kWidth = 80;
        constexpr std::uint32_t kHeight = 56;
        NodePaths paths(device.device());
        TraceBuffers buffers(device.device(), kWidth, kHeight);
        TraceOptions trace_options;
        trace_options.occlusion_rays = 2;
        const TraceCamera camera =
            traceCamera(ViewCamera::framing(scene.bounds(), 1.0 * kWidth / kHeight), grid, kHeight);
        count(made.pass_counts, device.run(
                                    [&](vk::FrameGraph& graph)
                                    {
                                        buildNodePaths(graph, result.octree, paths);
                                        trace(graph, result.octree, paths, camera, trace_options, buffers);
                                    }));
        made.most_submissions = std::max(made.most_submissions, device.submissionCount());
        made.image = device.download(buffers.image);
    }
    return made;
}

constexpr vk::SliceOptions kWhole{.submission_ms = 0};

TEST(Slicing, WholeRunsTakeOneSubmission)
{
    EXPECT_EQ(make(kWhole, test::materialsScene(10.0F), 5, {}).most_submissions, 1U);
}

TEST(Slicing, OneWorkgroupASubmissionGivesTheSameBytes)
{
    const Scene scene = test::materialsScene(10.0F);
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        const BuildOptions options{coverage, true, VoxelizeCapacities{1 << 10, 1 << 8, 1 << 10, 1 << 12, 1 << 10}};
        const Made expected = make(kWhole, scene, 5, options);
        const Made sliced = make({.most_units = 1}, scene, 5, options);
        EXPECT_EQ(sliced.sha, expected.sha);
        EXPECT_EQ(sliced.image, expected.image);
        EXPECT_GT(sliced.most_submissions, 100U);
    }
}

TEST(Slicing, OfAnySizeGivesTheSameBytes)
{
    const Scene scene = loadGltf(test::ownScene("cornell_box.glb"));
    const Made expected = make(kWhole, scene, 6, {});
    for (const std::uint64_t units : {7U, 64U, 1000U})
    {
        SCOPED_TRACE(units);
        const Made sliced = make({.most_units = units}, scene, 6, {});
        EXPECT_EQ(sliced.sha, expected.sha);
        EXPECT_EQ(sliced.image, expected.image);
        EXPECT_GT(sliced.most_submissions, 1U);
    }
}

TEST(Slicing, ByTimeGivesTheSameBytesColdAndWarm)
{
    const Scene scene = loadGltf(test::ownScene("knot.glb"));
    const Made expected = make(kWhole, scene, 8, {});
    vk::HeadlessDevice device(test::deviceOptions(), zvoKernels());
    const bool is_fast = device.device().report().type != "cpu"; // may need less than a millisecond in all
    for (const double ms : {0.01, 1.0, 20.0})
    {
        for (const int rounds : {1, 3})
        {
            const Made sliced = make({.submission_ms = ms}, scene, 8, {}, rounds);
            EXPECT_EQ(sliced.sha, expected.sha);
            EXPECT_EQ(sliced.image, expected.image);
            EXPECT_TRUE(sliced.most_submissions > 1 || (is_fast && ms > 0.1)) << ms;
        }
    }
}

TEST(Slicing, AWarmDeviceMakesTheSameBytesEveryTime)
{
    const Scene scene = loadGltf(test::ownScene("atrium.glb"));
    const std::string expected = make(kWhole, scene, 6, {}).sha;
    vk::HeadlessDevice device(test::deviceOptions(), zvoKernels());
    const GpuScene gpu_scene = uploadScene(device, scene, true);
    const Grid grid = Grid::around(scene.bounds(), 6);
    for (int round = 0; round < 6;
         ++round) // at first costs are unknown, later whole passes stand beside pieces of others
    {
        EXPECT_EQ(octreeSha256(device, buildOctree(device, gpu_scene, grid, {}).octree), expected) << round;
    }
}

TEST(Slicing, EveryPassIsReportedHoweverItWasSplit)
{
    const Scene scene = test::materialsScene(10.0F);
    const BuildOptions options{Coverage::Thin, true, VoxelizeCapacities{1 << 10, 1 << 8, 1 << 10, 1 << 12, 1 << 10}};
    const Made expected = make(kWhole, scene, 5, options);
    const Made sliced = make({.most_units = 3}, scene, 5, options);
    for (const auto& [name, times] : expected.pass_counts)
    {
        const auto found = sliced.pass_counts.find(name);
        ASSERT_NE(found, sliced.pass_counts.end()) << name;
        EXPECT_LE(found->second, times) << name; // neighbours of equal name may be one
    }
}

TEST(Slicing, ADeviceWithoutTimersLearnsFromTheClock)
{
    const Scene scene = loadGltf(test::ownScene("knot.glb"));
    vk::HeadlessOptions headless = test::deviceOptions();
    headless.timer_capacity = 0;
    headless.slices.submission_ms = 2;
    vk::HeadlessDevice device(headless, zvoKernels());
    const GpuScene gpu_scene = uploadScene(device, scene, true);
    const Grid grid = Grid::around(scene.bounds(), 7);
    const std::string expected = make(kWhole, scene, 7, {}).sha;
    for (int round = 0; round < 3; ++round)
    {
        EXPECT_EQ(octreeSha256(device, buildOctree(device, gpu_scene, grid, {}).octree), expected);
    }
}

} // namespace
} // namespace zvo
