// SPDX-License-Identifier: MIT
// Buffers that are too small, and memory that does not suffice. In the end there are the same bytes, or one clear
// error.
#include "core/base/kernels.h"
#include "core/scene/camera.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/materials_scene.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

namespace zvo
{
namespace
{

using test::device;

/// A build's bytes, and its result.
struct Built
{
    std::string sha;
    BuildResult result;
};

Built build(const Scene& scene, std::uint32_t depth, const BuildOptions& options)
{
    const GpuScene gpu_scene = uploadScene(device(), scene, options.attributes);
    Built built;
    built.result = buildOctree(device(), gpu_scene, Grid::around(scene.bounds(), depth), options);
    built.sha = octreeSha256(device(), built.result.octree);
    return built;
}

void expectSameBytesFrom(const VoxelizeCapacities& capacities, const Scene& scene, std::uint32_t depth)
{
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        for (const bool attributes : {true, false})
        {
            const Built expected = build(scene, depth, {coverage, attributes, {}});
            const Built grown = build(scene, depth, {coverage, attributes, capacities});
            EXPECT_EQ(grown.sha, expected.sha);
            EXPECT_EQ(grown.result.dropped, expected.result.dropped);
            EXPECT_GT(grown.result.octree.voxel_count, 100U);
            EXPECT_GT(grown.result.retry_count, 0U) << "everything had room from the start";
        }
    }
}

TEST(Capacity, OfOneGivesTheSameBytesForEveryMaterialClass)
{
    for (const std::uint32_t depth : {4U, 7U})
    {
        SCOPED_TRACE(depth);
        expectSameBytesFrom({1, 1, 1, 1, 1}, test::materialsScene(10.0F), depth);
    }
}

TEST(Capacity, OfOneGivesTheSameBytesForOwnScenes)
{
    for (const char* name : {"atrium.glb", "cornell_box.glb"})
    {
        SCOPED_TRACE(name);
        expectSameBytesFrom({1, 1, 1, 1, 1}, loadGltf(test::ownScene(name)), 5);
    }
}

TEST(Capacity, OfAnythingIsMadeUsable)
{
    const Scene scene = test::materialsScene(10.0F);
    for (const VoxelizeCapacities& capacities :
         {VoxelizeCapacities{}, VoxelizeCapacities{5, 2, 3, 7, 1}, VoxelizeCapacities{1 << 16, 1, 0, 1 << 16, 0}})
    {
        expectSameBytesFrom(capacities, scene, 5);
    }
}

TEST(Capacity, EachListGrowsOnItsOwn)
{
    const Scene scene = test::materialsScene(10.0F);
    const VoxelizeCapacities room = {1 << 12, 1 << 10, 1 << 12, 1 << 14, 1 << 10};
    const Built roomy = build(scene, 7, {Coverage::Thin, true, room});
    ASSERT_EQ(roomy.result.retry_count, 0U);
    for (std::uint64_t VoxelizeCapacities::*const count :
         {&VoxelizeCapacities::table, &VoxelizeCapacities::bricks, &VoxelizeCapacities::setups,
          &VoxelizeCapacities::items, &VoxelizeCapacities::large})
    {
        VoxelizeCapacities capacities = room;
        capacities.*count = 4;
        const Built grown = build(scene, 7, {Coverage::Thin, true, capacities});
        EXPECT_EQ(grown.sha, roomy.sha);
        EXPECT_GT(grown.result.retry_count, 0U);
    }
}

TEST(Capacity, ListsOfOneEntryTakeTwoMoreRunsAtMost)
{
    for (const char* name : {"atrium.glb", "cornell_box.glb"})
    {
        SCOPED_TRACE(name);
        const Built grown =
            build(loadGltf(test::ownScene(name)), 8, {Coverage::Thin, false, VoxelizeCapacities{1 << 20, 1, 1, 1, 1}});
        EXPECT_GE(grown.result.retry_count, 1U);
        EXPECT_LE(grown.result.retry_count, 2U);
    }
}

TEST(Capacity, SumsThatOverflowWithCapacitiesOfOneStillGiveTheSameBytes)
{
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 70000; ++i)
    {
        corners.insert(corners.end(), {{1.2F, 1.5F, 1.2F}, {1.2F, 1.5F, 1.8F}, {1.8F, 1.5F, 1.8F}});
    }
    corners.insert(corners.end(), {{0, 0, 0}, {16, 16, 16}, {0, 16, 0}}); // over several leaves
    const Scene scene = test::triangleSoup(corners);
    const Built expected = build(scene, 4, {Coverage::Thin, true, {}});
    const Built grown = build(scene, 4, {Coverage::Thin, true, VoxelizeCapacities{1, 1, 1, 1, 1}});
    EXPECT_EQ(grown.sha, expected.sha);
    EXPECT_GE(grown.result.retry_count, 2U) << "lists, and sums";
}

/// A whole small run on its own device under a memory limit: the digest of the octree, and a picture.
struct LimitedRun
{
    std::string sha;
    std::vector<gpu::uint> image;
    std::string error; // message of exit code 6; empty: it succeeded
    std::uint64_t peak_bytes = 0;
};

LimitedRun runUnder(std::uint64_t limit, const Scene& scene, std::uint32_t depth, bool attributes)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.memory_budget_bytes = limit;
    LimitedRun run;
    vk::HeadlessDevice limited(options, zvoKernels());
    try
    {
        const GpuScene gpu_scene = uploadScene(limited, scene, attributes);
        const Grid grid = Grid::around(scene.bounds(), depth);
        const BuildResult result = buildOctree(limited, gpu_scene, grid, {Coverage::Thin, attributes, {}});
        run.sha = octreeSha256(limited, result.octree);
        const TraceCamera camera = traceCamera(ViewCamera::framing(scene.bounds(), 64.0 / 48.0), grid, 48);
        run.image = test::takePicture(limited, result.octree, camera, 64, 48, {}).image;
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Memory) << error.what();
        run.error = error.what();
    }
    run.peak_bytes = limited.device().memory().peakHeldBytes();
    EXPECT_LE(limited.device().memory().peakBytes(), run.peak_bytes);
    return run;
}

void expectLimitsAreKept(const Scene& scene, std::uint32_t depth, bool attributes)
{
    const LimitedRun expected = runUnder(std::uint64_t{1} << 40, scene, depth, attributes);
    ASSERT_EQ(expected.error, "");
    ASSERT_EQ(expected.sha, runUnder(UINT64_MAX, scene, depth, attributes).sha);
    std::uint32_t failure_count = 0;
    bool succeeded = false;
    for (std::uint64_t limit = 64 << 10; limit <= 2 * expected.peak_bytes; limit += limit / 2)
    {
        const LimitedRun run = runUnder(limit, scene, depth, attributes);
        EXPECT_LE(run.peak_bytes, limit);
        if (run.error.empty())
        {
            succeeded = true;
            EXPECT_EQ(run.sha, expected.sha);
            EXPECT_EQ(run.image, expected.image);
            continue;
        }
        EXPECT_FALSE(succeeded) << "a smaller limit had sufficed: " << run.error;
        EXPECT_EQ(run.error.find('\n'), std::string::npos);
        EXPECT_GT(test::bytesNeeded(run.error), limit) << run.error;
        ++failure_count;
    }
    EXPECT_TRUE(succeeded);
    EXPECT_GT(failure_count, 5U);
}

TEST(MemoryLimit, IsKeptAndEitherSufficesOrNamesASize)
{
    expectLimitsAreKept(test::materialsScene(10.0F), 7, true);
    expectLimitsAreKept(loadGltf(test::ownScene("knot.glb")), 7, false);
}

TEST(MemoryLimit, RaisedToTheSizeNeededGetsThroughInAFewSteps)
{
    const Scene scene = test::materialsScene(10.0F);
    std::uint64_t limit = 64 << 10;
    std::string last;
    std::uint32_t steps = 0;
    for (; steps < 12; ++steps)
    {
        const LimitedRun run = runUnder(limit, scene, 8, true);
        if (run.error.empty())
        {
            EXPECT_LE(run.peak_bytes, limit);
            break;
        }
        EXPECT_NE(run.error, last);
        last = run.error;
        const std::uint64_t needed = test::bytesNeeded(run.error);
        ASSERT_GT(needed, limit);
        limit = needed;
    }
    EXPECT_LT(steps, 12U) << last;
    // The reported sizes are not exaggerated: the last limit is what an unlimited run holds, up to a part of a block of
    // memory.
    constexpr std::uint64_t kBlockBytes = 1 << 20;
    EXPECT_LE(limit, runUnder(std::uint64_t{1} << 40, scene, 8, true).peak_bytes + kBlockBytes);
}

} // namespace
} // namespace zvo
