// SPDX-License-Identifier: MIT
// The work of large triangles, counted as columns of their row blocks.
#include "core/base/divide_up.h"
#include "core/base/kernels.h"
#include "core/voxelize/voxelize.h"
#include "support/device.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

namespace zvo
{
namespace
{

std::uint64_t voxelsOf(RowShape shape)
{
    return std::uint64_t{gpu::kBlockRows} * shape.block_columns;
}

std::uint64_t countBlocks(const std::vector<glm::vec3>& corners, std::uint32_t depth, Coverage coverage,
                          RowShape shape = {})
{
    vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
    const GpuScene scene = uploadScene(device, test::triangleSoup(corners), false);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
    VoxelizeBuffers buffers(device.device(), VoxelizeCapacities::estimate(scene, grid, shape), scene, shape);
    const VoxelizeJob job = {.scene = scene, .tile = grid, .coverage = coverage, .buffers = buffers};
    device.run([&](vk::FrameGraph& graph) { voxelizeCoverage(graph, job); });
    const gpu::RasterCounters counters = device.download(buffers.rowsOf(MaterialClass::Plain).counters).front();
    EXPECT_GE(counters.big_count, corners.size() / 3);
    EXPECT_LE(counters.big_count, buffers.rowsOf(MaterialClass::Plain).big_triangles.count());
    EXPECT_LE(counters.block_count, buffers.rowsOf(MaterialClass::Plain).row_blocks.count());
    EXPECT_EQ(counters.rows.x * counters.rows.y,
              divideUp(std::uint64_t{counters.block_count} * gpu::kBlockRows, gpu::kRowsGroup));
    EXPECT_EQ(counters.arrived, 0U);
    return counters.block_count;
}

using BalanceBothCoverages = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, BalanceBothCoverages, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

TEST_P(BalanceBothCoverages, TriangleOfAMillionVoxelsListsBlocksForItsAreaNotForItsBox)
{
    // Half of a box of 1448^2 columns, which is 1024^2.
    for (const RowShape shape : {RowShape{256, 1}, RowShape{32, 16}, RowShape{8, 32}})
    {
        SCOPED_TRACE(shape.block_columns);
        const std::uint64_t blocks = countBlocks({{1, 1, 10}, {1449, 1, 300}, {1, 1449, 200}}, 11, GetParam(), shape);
        EXPECT_GE(blocks * voxelsOf(shape), 1024ULL * 1024) << "less than the triangle has";
        EXPECT_LE(blocks * voxelsOf(shape), 1024ULL * 1024 * 5 / 4);
    }
}

TEST_P(BalanceBothCoverages, SliverListsOneOrTwoBlocksForEightRows)
{
    for (const std::uint32_t depth : {10U, 11U, 12U})
    {
        const float edge = static_cast<float>(1U << depth);
        const std::uint64_t bands = (1U << depth) / gpu::kBlockRows;
        const std::uint64_t blocks = countBlocks({{1, 1, 1}, {edge - 1, edge - 2, 9}, {1, 1.5F, 1}}, depth, GetParam());
        SCOPED_TRACE(depth);
        EXPECT_GE(blocks, bands);
        EXPECT_LE(blocks, bands + (1U << depth) / RowShape().block_columns * 2);
    }
}

TEST_P(BalanceBothCoverages, TwiceTheResolutionListsFourTimesTheBlocksAtMost)
{
    std::uint64_t before = 0;
    for (std::uint32_t depth = 9; depth <= 12; ++depth)
    {
        const float edge = static_cast<float>(1U << depth);
        const std::uint64_t blocks =
            countBlocks({{0, 0, 0}, {edge, 0, edge / 3}, {edge / 2, edge, edge / 2}}, depth, GetParam());
        EXPECT_TRUE(before == 0 || blocks <= before * 9 / 2) << before << " blocks, then " << blocks;
        before = blocks;
    }
}

// The last subgroup of each part sizes the dispatches that follow; repeats begin with cleared counters.
TEST_P(BalanceBothCoverages, WalksInPartsAndRepeatsSizeTheSameDispatches)
{
    vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
    const GpuScene scene = uploadScene(device, test::randomTriangles(3, 300, 300.0F), false);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 8};
    const VoxelizeCapacities capacities = VoxelizeCapacities::estimate(scene, grid, {});
    VoxelizeBuffers buffers(device.device(), capacities, scene);
    const VoxelizeJob job = {.scene = scene, .tile = grid, .coverage = GetParam(), .buffers = buffers};
    const auto counters = [&] { return device.download(buffers.rowsOf(MaterialClass::Plain).counters).front(); };
    device.run([&](vk::FrameGraph& graph) { voxelizeCoverage(graph, job); });
    const gpu::RasterCounters whole = counters();
    ASSERT_GT(whole.big_count, 100U);
    ASSERT_EQ(scene.chunksOf(MaterialClass::Plain).workgroups(), 5U);
    for (int repeat = 0; repeat < 2; ++repeat)
    {
        device.run(
            [&](vk::FrameGraph& graph)
            {
                const RasterWalk walk = {job};
                clearCoverage(graph, buffers);
                for (const auto& [first, count] : {std::pair{0, 1}, {1, 0}, {1, 3}, {4, 1}})
                {
                    walkTriangles(graph, walk, MaterialClass::Plain, first, count);
                }
                listRows(graph, walk, MaterialClass::Plain);
                walkRows(graph, walk, MaterialClass::Plain);
            });
        const gpu::RasterCounters parts = counters();
        EXPECT_EQ(std::memcmp(&parts, &whole, sizeof(parts)), 0);
    }
}

} // namespace
} // namespace zvo
