// SPDX-License-Identifier: MIT
// The work of large triangles, counted as items.
#include "core/base/divide_up.h"
#include "core/voxelize/voxelize.h"
#include "support/engine_device.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

std::uint64_t countItems(const std::vector<glm::vec3>& corners, std::uint32_t depth, Coverage coverage)
{
    const GpuScene scene = uploadScene(device(), test::triangleSoup(corners), false);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
    VoxelizeBuffers buffers(device().device(), VoxelizeCapacities::estimate(scene, grid, coverage), scene,
                            {.coverage = coverage, .attributes = false});
    device().run([&](vk::FrameGraph& graph) { voxelizeCoverage(graph, {scene, grid, buffers}); });
    const gpu::BinCounters counters = device().download(buffers.counters).front();
    EXPECT_EQ(counters.fits, 1U) << "the estimate was too small";
    EXPECT_EQ(counters.covered_items, counters.item_count);
    EXPECT_EQ(counters.cover.x * counters.cover.y, divideUp(counters.item_count, gpu::kItemsGroup));
    EXPECT_EQ(counters.arrived, 0U);
    return counters.item_count;
}

using BalanceBothCoverages = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, BalanceBothCoverages, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

TEST_P(BalanceBothCoverages, TriangleOfAMillionVoxelsHasItemsForItsAreaNotForItsBox)
{
    // Half of a box of 1448^2 columns, which is 1024^2.
    const std::uint64_t items = countItems({{1, 1, 10}, {1449, 1, 300}, {1, 1449, 200}}, 11, GetParam());
    EXPECT_GE(items * gpu::kItemColumns, 1024ULL * 1024) << "less than the triangle has";
    EXPECT_LE(items * gpu::kItemColumns, 1024ULL * 1024 * 4 / 3);
}

TEST_P(BalanceBothCoverages, SliverHasItemsForItsLength)
{
    for (const std::uint32_t depth : {10U, 11U, 12U})
    {
        const float edge = static_cast<float>(1U << depth);
        const std::uint64_t items = countItems({{1, 1, 1}, {edge - 1, edge - 2, 9}, {1, 1.5F, 1}}, depth, GetParam());
        SCOPED_TRACE(depth);
        EXPECT_GE(items, (1U << depth) / 4);
        EXPECT_LE(items, (1U << depth) * 3 / 4); // a line through tiles of 4^2 touches up to two for 4 columns
    }
}

TEST_P(BalanceBothCoverages, TwiceTheResolutionMakesFourTimesTheItemsAtMost)
{
    std::uint64_t before = 0;
    for (std::uint32_t depth = 9; depth <= 12; ++depth)
    {
        const float edge = static_cast<float>(1U << depth);
        const std::uint64_t items =
            countItems({{0, 0, 0}, {edge, 0, edge / 3}, {edge / 2, edge, edge / 2}}, depth, GetParam());
        EXPECT_TRUE(before == 0 || items <= before * 9 / 2) << before << " items, then " << items;
        before = items;
    }
}

// The last subgroup of each part sizes the dispatches that follow; repeats begin with cleared counters.
TEST_P(BalanceBothCoverages, TrianglesInPartsAndRepeatsSizeTheSameDispatches)
{
    const GpuScene scene = uploadScene(device(), test::randomTriangles(3, 300, 300.0F), false);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 8};
    VoxelizeBuffers buffers(device().device(), VoxelizeCapacities::estimate(scene, grid, GetParam()), scene,
                            {.coverage = GetParam(), .attributes = false});
    const VoxelizeJob job = {scene, grid, buffers};
    const auto counters = [&] { return device().download(buffers.counters).front(); };
    device().run([&](vk::FrameGraph& graph) { voxelizeCoverage(graph, job); });
    const gpu::BinCounters whole = counters();
    ASSERT_GT(whole.large_count, 100U);
    ASSERT_EQ(scene.chunksOf(MaterialClass::Plain).workgroups(), 5U);
    for (int repeat = 0; repeat < 2; ++repeat)
    {
        device().run(
            [&](vk::FrameGraph& graph)
            {
                clearVoxels(graph, buffers);
                for (const auto& [first, count] : {std::pair{0, 1}, {1, 0}, {1, 3}, {4, 1}})
                {
                    binTriangles(graph, job, MaterialClass::Plain, first, count);
                }
                coverBricks(graph, job);
            });
        const gpu::BinCounters parts = counters();
        EXPECT_EQ(std::memcmp(&parts, &whole, sizeof(parts)), 0);
    }
}

} // namespace
} // namespace zvo
