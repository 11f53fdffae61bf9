// SPDX-License-Identifier: MIT
// Roots of dynamic updates: their nodes stand behind those of the octree that was changed, or there are none.
#include "core/trace/trace.h"
#include "oracle/morton.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/relocate.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"
#include "support/tree_comparison.h"
#include "trace/node_paths.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <random>
#include <string>
#include <utility>

namespace zvo
{
namespace
{

using test::device;
using test::hitCount;
using test::Picture;
using test::takePicture;
using test::TreeComparison;

constexpr std::uint32_t kFar = 100000; // nodes; does not fit 16 bits
constexpr std::array kRootViews = {View::Color, View::Albedo,     View::Normal, View::Depth,
                                   View::Level, View::Iterations, View::Voxel,  View::Bricks};

DeviceTree withAttributes(const test::CodeSet& set)
{
    DeviceTree octree = test::octreeOf(device(), set.codes, set.depth);
    test::addAttributes(device(), octree);
    return octree;
}

// 20,000 random voxels, with four levels of nodes.
DeviceTree randomOctree(std::uint32_t seed)
{
    std::mt19937 random(seed);
    return withAttributes({8, test::randomCodes(8, 20000, random)});
}

ViewCamera frontOf(const DeviceTree& octree)
{
    return test::manyCameras(octree.grid).front();
}

// Layouts of updates: only the root changed, everything changed, and both numberings of level 2.
std::vector<DeviceTree> relocations(const DeviceTree& octree)
{
    std::vector<DeviceTree> result;
    for (const test::RelocateOptions& update : {test::RelocateOptions{.gap = 0, .touched_percent = 50},
                                                {.gap = kFar, .touched_percent = 0},
                                                {.gap = kFar, .touched_percent = 60},
                                                {.gap = kFar, .touched_percent = 100}})
    {
        result.push_back(test::relocate(device(), octree, update));
    }
    return result;
}

// Calls compare(comparison) for an octree and each of its relocations.
template <typename Compare> void compareRelocations(const DeviceTree& octree, const Compare& compare)
{
    std::size_t update = 0;
    for (const DeviceTree& relocated : relocations(octree))
    {
        SCOPED_TRACE("depth " + std::to_string(octree.grid.depth) + " update " + std::to_string(update++));
        TreeComparison comparison(device(), octree, relocated);
        compare(comparison);
    }
}

TEST(TraceRoots, EveryViewOfARelocatedOctreeIsTheSame)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        const DeviceTree octree = withAttributes(set);
        compareRelocations(octree, [&](TreeComparison& comparison) { comparison.views(frontOf(octree), true); });
    }
}

TEST(TraceRoots, EveryCameraSeesTheSameWithAndWithoutBeam)
{
    TraceOptions options;
    options.view = View::Iterations;
    for (const test::CodeSet& set : test::codeSets())
    {
        compareRelocations(withAttributes(set), [&](TreeComparison& comparison) { comparison.cameras(1, options); });
    }
}

TEST(TraceRoots, RaysHitTheSame)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        compareRelocations(withAttributes(set), [&](TreeComparison& comparison) { comparison.rays(set.codes); });
    }
}

TEST(TraceRoots, LevelsOfDetailStopAtTheSameNodes)
{
    const DeviceTree octree = randomOctree(13);
    compareRelocations(octree, [&](TreeComparison& comparison) { comparison.detail(frontOf(octree), true); });
}

/// The entry of paths.cells for a cell.
struct Path
{
    std::array<std::uint32_t, gpu::kPathLevels> nodes;
    bool operator==(const Path&) const = default;
};

// The nodes that contain each of kPathCells^3 cells, found by descent from the root; 0 if there is none.
std::vector<Path> pathsOf(const std::vector<gpu::Node>& nodes)
{
    std::vector<Path> paths;
    for (std::uint32_t i = 0; i < gpu::kPathCells * gpu::kPathCells * gpu::kPathCells; ++i)
    {
        const glm::uvec3 cell(i % gpu::kPathCells, i / gpu::kPathCells % gpu::kPathCells,
                              i / gpu::kPathCells / gpu::kPathCells);
        const std::uint64_t code = oracle::mortonEncode(cell);
        Path path{};
        std::uint32_t node = 0;
        for (std::uint32_t level = 0; level < gpu::kPathLevels; ++level)
        {
            const std::uint32_t c = code >> (6 * (gpu::kPathLevels - 1 - level)) & 63;
            const std::uint32_t mask = c < 32 ? nodes.at(node).mask_lo : nodes.at(node).mask_hi;
            if ((mask >> (c % 32) & 1) == 0)
            {
                break;
            }
            node = (c < 32 ? nodes.at(node).base_lo : nodes.at(node).base_hi) +
                   static_cast<std::uint32_t>(std::popcount(mask & ((1U << (c % 32)) - 1)));
            path.nodes.at(level) = node;
        }
        paths.push_back(path);
    }
    return paths;
}

// The paths on the device, decoded as shaders/trace/node_paths.h describes them.
std::vector<Path> devicePathsOf(const DeviceTree& octree, const std::vector<gpu::Node>& nodes)
{
    NodePaths table(device().device());
    device().run([&](vk::FrameGraph& graph) { buildNodePaths(graph, octree, table); });
    const std::uint32_t before = nodes.at(0).base_lo - 1;
    std::vector<Path> paths;
    for (const std::uint64_t word : device().download(table.cells))
    {
        const auto node1 = static_cast<std::uint32_t>(word & 255);
        const auto node2 = static_cast<std::uint32_t>(word >> 8 & 65535);
        const bool relative = (word >> 24 & 1) != 0;
        paths.push_back({{node1 != 0 ? before + node1 : 0, relative ? before + node2 : node2,
                          static_cast<std::uint32_t>(word >> 32)}});
    }
    return paths;
}

TEST(TraceRoots, RaysBeginAtTheLowestNodesOfEveryUpdate)
{
    std::mt19937 random(14);
    for (const std::uint32_t depth : {7U, 8U, 11U})
    {
        const DeviceTree octree = test::octreeOf(device(), test::randomCodes(depth, 20000, random), depth);
        const std::vector<gpu::Node> nodes = device().download(octree.nodes);
        EXPECT_EQ(devicePathsOf(octree, nodes), pathsOf(nodes));
        for (const DeviceTree& relocated : relocations(octree))
        {
            const std::vector<gpu::Node> moved = device().download(relocated.nodes);
            EXPECT_EQ(devicePathsOf(relocated, moved), pathsOf(moved));
        }
    }
}

TEST(TraceRoots, RaysBeginAboveNodesThatPathsCannotName)
{
    const DeviceTree octree = randomOctree(15);
    const DeviceTree relocated = test::relocate(device(), octree, {.gap = kFar, .level_gap = kFar});
    const std::vector<gpu::Node> nodes = device().download(relocated.nodes);
    std::vector<Path> expected = pathsOf(nodes);
    std::uint32_t cut_count = 0;
    for (Path& path : expected)
    {
        if (path.nodes[1] > kFar) // level 2 is too far behind level 1
        {
            path = {{path.nodes[0], 0, 0}};
            ++cut_count;
        }
    }
    EXPECT_GT(cut_count, 1000U);
    EXPECT_LT(cut_count, expected.size() - 1000);
    EXPECT_EQ(devicePathsOf(relocated, nodes), expected);
    TreeComparison(device(), octree, relocated).cameras(1);
}

TEST(TraceRoots, LevelsOfTheOctreeThatWasChangedMayStay)
{
    const DeviceTree octree = randomOctree(18);
    for (DeviceTree& relocated : relocations(octree))
    {
        relocated.levels = octree.levels;
        relocated.node_count = octree.node_count;
        EXPECT_GT(TreeComparison(device(), octree, relocated).picture(frontOf(octree)), 0U);
    }
}

TEST(TraceRoots, HalvesOfARootMayStandApart)
{
    // The format allows the children of a node's two halves to be apart.
    const DeviceTree octree = randomOctree(16);
    DeviceTree relocated = test::relocate(device(), octree, {.touched_percent = 0});
    std::vector<gpu::Node> nodes = device().download(relocated.nodes);
    const auto upper_count = static_cast<std::uint32_t>(std::popcount(nodes[0].mask_hi));
    ASSERT_GT(upper_count, 16U);
    const auto moved = static_cast<std::uint32_t>(nodes.size()) + kFar;
    nodes.resize(moved + upper_count);
    for (std::uint32_t i = 0; i < upper_count; ++i)
    {
        nodes[moved + i] = std::exchange(nodes[nodes[0].base_hi + i], gpu::Node{~0U, 0, ~0U, 0});
    }
    nodes[0].base_hi = moved;
    relocated.nodes = device().makeBuffer("nodes", std::span<const gpu::Node>(nodes));
    relocated.node_count = static_cast<std::uint32_t>(nodes.size());
    TreeComparison(device(), octree, relocated).cameras(1);
}

TEST(TraceRoots, ARootThatWasEmptyInBetweenIsTheSame)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        SCOPED_TRACE(set.depth);
        DeviceTree octree = withAttributes(set);
        const DeviceTree nothing = test::octreeOf(device(), {}, set.depth);
        const gpu::Node root = device().download(octree.nodes, 0, 1).at(0);
        // The bases of an empty root have no meaning.
        const gpu::Node empty = {.mask_lo = 0, .base_lo = 12345, .mask_hi = 0, .base_hi = ~0U};
        NodePaths paths(device().device());
        TraceBuffers buffers(device().device(), 99, 70);
        // The camera is so close that tiles are narrower than voxels.
        const glm::dvec3 voxel = glm::dvec3(oracle::mortonDecode(set.codes.front())) + 0.5;
        const glm::dvec3 eye = voxel + static_cast<double>(octree.grid.resolution()) * glm::dvec3(-0.4, -0.7, -2.5);
        const TraceCamera camera = traceCamera(ViewCamera::lookAt(eye, voxel, 0.008), octree.grid, 70);
        const auto take = [&](const gpu::Node& with, const TraceOptions& options)
        {
            device().run([&](vk::FrameGraph& graph) { graph.update(octree.nodes, 0, std::span(&with, 1)); });
            return takePicture(device(), octree, paths, camera, buffers, options);
        };
        for (const View view : kRootViews)
        {
            for (const bool use_beam : {true, false})
            {
                TraceOptions options;
                options.view = view;
                options.beam = use_beam;
                options.occlusion_rays = 2;
                const Picture before = take(root, options);
                const Picture between = take(empty, options);
                const Picture after = take(root, options);
                EXPECT_GT(hitCount(before), 0U);
                EXPECT_EQ(hitCount(between), 0U);
                EXPECT_EQ(between.capped_rays, 0U);
                EXPECT_EQ(before.image, after.image);
                EXPECT_EQ(between.live_tiles, use_beam ? 0U : 13U * 9U);
                if (use_beam || view != View::Iterations)
                {
                    EXPECT_EQ(between.image, takePicture(device(), nothing, camera, 99, 70, options).image);
                }
            }
        }
    }
}

TEST(TraceRoots, AnOctreeOfAnEmptyRootIsNeverHit)
{
    std::mt19937 random(17);
    for (const std::uint32_t depth : {1U, 2U, 3U, 8U, 17U})
    {
        DeviceTree octree = test::octreeOf(device(), {}, depth);
        const gpu::Node empty = {.mask_lo = 0, .base_lo = 12345, .mask_hi = 0, .base_hi = ~0U};
        octree.nodes = device().makeBuffer("nodes", std::span(&empty, 1));
        octree.node_count = 1;
        const test::Codes codes = test::randomCodes(depth, 20, random); // where rays aim
        const std::vector<gpu::Ray> rays = test::pickRays(random, octree.grid.rootResolution(), codes, 500);
        for (const gpu::Hit& hit : test::traceOnDevice(device(), octree, rays))
        {
            ASSERT_EQ(hit.index, gpu::kHitMiss) << depth;
        }
        for (const ViewCamera& view : test::manyCameras(octree.grid))
        {
            const TraceCamera camera = traceCamera(view, octree.grid, 41);
            EXPECT_EQ(hitCount(takePicture(device(), octree, camera, 53, 41, {})), 0U) << depth;
        }
    }
}

} // namespace
} // namespace zvo
