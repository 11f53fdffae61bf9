// SPDX-License-Identifier: MIT
// Roots of dynamic updates: their nodes stand behind those of the octree that was changed, or there are none.
#include "core/trace/trace.h"
#include "oracle/morton.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/relocate.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"
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

using test::hitCount;
using test::Picture;
using test::Relocated;
using test::takePicture;

constexpr std::uint32_t kFar = 100000; // nodes; does not fit 16 bits
constexpr std::array kRootViews = {View::Color, View::Albedo,     View::Normal, View::Depth,
                                   View::Level, View::Iterations, View::Voxel,  View::Bricks};

using test::device;

DeviceTree withAttributes(const test::Codes& codes, std::uint32_t depth)
{
    DeviceTree octree = test::octreeOf(device(), codes, depth);
    test::addAttributes(device(), octree);
    return octree;
}

// nodes: hits are nodes at which a level of detail stopped, or voxels.
void expectSameHit(const gpu::Hit& expected, const gpu::Hit& hit, const Relocated& relocated)
{
    ASSERT_EQ(hit.index == gpu::kHitMiss, expected.index == gpu::kHitMiss);
    if (hit.index == gpu::kHitMiss)
    {
        return;
    }
    ASSERT_EQ(std::bit_cast<std::uint32_t>(hit.t), std::bit_cast<std::uint32_t>(expected.t));
    ASSERT_EQ(hit.where, expected.where);
    const bool is_voxel = test::unpack(hit)->level == relocated.octree.grid.nodeLevels();
    ASSERT_EQ((is_voxel ? relocated.original_voxels : relocated.original_nodes).at(hit.index), expected.index);
}

void expectSamePicture(const Picture& expected, const Picture& picture, const Relocated& relocated)
{
    EXPECT_EQ(picture.image, expected.image);
    EXPECT_EQ(picture.light, expected.light);
    EXPECT_EQ(picture.live_tiles, expected.live_tiles);
    EXPECT_EQ(picture.capped_rays, 0U);
    for (std::size_t i = 0; i < expected.hits.size(); ++i)
    {
        ASSERT_NO_FATAL_FAILURE(expectSameHit(expected.hits[i], picture.hits[i], relocated)) << "pixel " << i;
    }
}

std::vector<std::pair<std::uint32_t, test::Codes>> codeSets()
{
    std::mt19937 random(11);
    return {
        {1, {0, 5}},
        {2, test::randomCodes(2, 20, random)},
        {4, test::randomCodes(4, 200, random)},
        {6, test::sphereShell(6, 24.0)},
        {7, test::randomCodes(7, 3000, random)},
        {8, test::sphereShell(8, 110.0)},
        {11, test::randomCodes(11, 20000, random)},
    };
}

// Layouts of updates: only the root changed, everything changed, and both numberings of level 2.
std::vector<test::RelocateOptions> updates()
{
    return {
        {.gap = 0, .touched_percent = 50},
        {.gap = kFar, .touched_percent = 0},
        {.gap = kFar, .touched_percent = 60},
        {.gap = kFar, .touched_percent = 100},
    };
}

std::vector<Relocated> relocations(const DeviceTree& octree)
{
    std::vector<Relocated> result;
    for (const test::RelocateOptions& update : updates())
    {
        result.push_back(test::relocate(device(), octree, update));
    }
    return result;
}

std::string traceOf(const DeviceTree& octree, std::size_t update, std::size_t number)
{
    return "depth " + std::to_string(octree.grid.depth) + " update " + std::to_string(update) + " number " +
           std::to_string(number);
}

// Compares pictures of octree and of its relocations.
void expectSamePictures(const DeviceTree& octree, const std::vector<Relocated>& relocated, const ViewCamera& view,
                        std::uint32_t width, std::uint32_t height, const TraceOptions& options, std::size_t number)
{
    const TraceCamera camera = traceCamera(view, octree.grid, height);
    const Picture expected = takePicture(device(), octree, camera, width, height, options);
    for (std::size_t i = 0; i < relocated.size(); ++i)
    {
        SCOPED_TRACE(traceOf(octree, i, number));
        expectSamePicture(expected, takePicture(device(), relocated[i].octree, camera, width, height, options),
                          relocated[i]);
    }
    if (number == 0)
    {
        EXPECT_GT(hitCount(expected), 0U);
    }
}

TEST(TraceRoots, EveryViewOfARelocatedOctreeIsTheSame)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const DeviceTree octree = withAttributes(codes, depth);
        const std::vector<Relocated> relocated = relocations(octree);
        const ViewCamera view = test::manyCameras(octree.grid).front();
        for (const View shown : kRootViews)
        {
            TraceOptions options;
            options.view = shown;
            options.occlusion_rays = 2;
            expectSamePictures(octree, relocated, view, 99, 70, options, 0);
        }
    }
}

TEST(TraceRoots, EveryCameraSeesTheSameWithAndWithoutBeam)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const DeviceTree octree = withAttributes(codes, depth);
        const std::vector<Relocated> relocated = relocations(octree);
        const std::vector<ViewCamera> views = test::manyCameras(octree.grid);
        for (std::size_t i = 0; i < views.size(); ++i)
        {
            TraceOptions options;
            options.view = View::Iterations;
            options.beam = i % 2 == 0;
            expectSamePictures(octree, relocated, views[i], 53, 41, options, i);
        }
    }
}

TEST(TraceRoots, RaysHitTheSame)
{
    std::mt19937 random(12);
    for (const auto& [depth, codes] : codeSets())
    {
        const DeviceTree octree = test::octreeOf(device(), codes, depth);
        const std::vector<Relocated> relocated = relocations(octree);
        std::vector<gpu::Ray> rays;
        for (int i = 0; i < 2049; ++i)
        {
            rays.push_back(test::deviceRay(test::pickRay(random, octree.grid.rootResolution(), codes)));
        }
        const std::vector<gpu::Hit> expected = test::traceOnDevice(device(), octree, rays);
        for (std::size_t i = 0; i < relocated.size(); ++i)
        {
            const std::vector<gpu::Hit> hits = test::traceOnDevice(device(), relocated[i].octree, rays);
            for (std::size_t ray = 0; ray < rays.size(); ++ray)
            {
                ASSERT_NO_FATAL_FAILURE(expectSameHit(expected[ray], hits[ray], relocated[i]))
                    << traceOf(octree, i, ray);
            }
        }
    }
}

TEST(TraceRoots, LevelsOfDetailStopAtTheSameNodes)
{
    std::mt19937 random(13);
    const DeviceTree octree = withAttributes(test::randomCodes(8, 20000, random), 8);
    const std::vector<Relocated> relocated = relocations(octree);
    const ViewCamera view = test::manyCameras(octree.grid).front();
    for (const std::uint32_t level : {1U, 2U, 3U, UINT32_MAX})
    {
        TraceOptions options;
        options.detail_level = level;
        options.detail_pixels = level == UINT32_MAX ? 6.0F : 0.0F;
        expectSamePictures(octree, relocated, view, 99, 70, options, 0);
    }
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
        for (const Relocated& relocated : relocations(octree))
        {
            const std::vector<gpu::Node> moved = device().download(relocated.octree.nodes);
            EXPECT_EQ(devicePathsOf(relocated.octree, moved), pathsOf(moved));
        }
    }
}

TEST(TraceRoots, RaysBeginAboveNodesThatPathsCannotName)
{
    std::mt19937 random(15);
    const DeviceTree octree = withAttributes(test::randomCodes(8, 20000, random), 8);
    const Relocated relocated =
        test::relocate(device(), octree, {.gap = kFar, .level_gap = kFar, .touched_percent = 50});
    const std::vector<gpu::Node> nodes = device().download(relocated.octree.nodes);
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
    EXPECT_EQ(devicePathsOf(relocated.octree, nodes), expected);
    for (const ViewCamera& view : test::manyCameras(octree.grid))
    {
        const TraceCamera camera = traceCamera(view, octree.grid, 41);
        expectSamePicture(takePicture(device(), octree, camera, 53, 41, {}),
                          takePicture(device(), relocated.octree, camera, 53, 41, {}), relocated);
    }
}

TEST(TraceRoots, LevelsOfTheOctreeThatWasChangedMayStay)
{
    std::mt19937 random(18);
    const DeviceTree octree = withAttributes(test::randomCodes(8, 20000, random), 8);
    std::vector<Relocated> relocated = relocations(octree);
    for (Relocated& each : relocated)
    {
        each.octree.levels = octree.levels;
        each.octree.node_count = octree.node_count;
    }
    expectSamePictures(octree, relocated, test::manyCameras(octree.grid).front(), 99, 70, {}, 0);
}

TEST(TraceRoots, HalvesOfARootMayStandApart)
{
    // The format allows the children of a node's two halves to be apart.
    std::mt19937 random(16);
    const DeviceTree octree = withAttributes(test::randomCodes(8, 20000, random), 8);
    Relocated relocated = test::relocate(device(), octree, {.touched_percent = 0});
    std::vector<gpu::Node> nodes = device().download(relocated.octree.nodes);
    const auto upper_count = static_cast<std::uint32_t>(std::popcount(nodes[0].mask_hi));
    ASSERT_GT(upper_count, 16U);
    const auto moved = static_cast<std::uint32_t>(nodes.size()) + kFar;
    nodes.resize(moved + upper_count);
    relocated.original_nodes.resize(nodes.size(), Relocated::kUnused);
    for (std::uint32_t i = 0; i < upper_count; ++i)
    {
        nodes[moved + i] = std::exchange(nodes[nodes[0].base_hi + i], gpu::Node{~0U, 0, ~0U, 0});
    }
    nodes[0].base_hi = moved;
    relocated.octree.nodes = device().makeBuffer("nodes", std::span<const gpu::Node>(nodes));
    relocated.octree.node_count = static_cast<std::uint32_t>(nodes.size());
    for (const ViewCamera& view : test::manyCameras(octree.grid))
    {
        const TraceCamera camera = traceCamera(view, octree.grid, 41);
        expectSamePicture(takePicture(device(), octree, camera, 53, 41, {}),
                          takePicture(device(), relocated.octree, camera, 53, 41, {}), relocated);
    }
}

TEST(TraceRoots, ARootThatWasEmptyInBetweenIsTheSame)
{
    for (const auto& [depth, codes] : codeSets())
    {
        SCOPED_TRACE(depth);
        DeviceTree octree = withAttributes(codes, depth);
        const DeviceTree nothing = test::octreeOf(device(), {}, depth);
        const gpu::Node root = device().download(octree.nodes, 0, 1).at(0);
        // The bases of an empty root have no meaning.
        const gpu::Node empty = {.mask_lo = 0, .base_lo = 12345, .mask_hi = 0, .base_hi = ~0U};
        NodePaths paths(device().device());
        TraceBuffers buffers(device().device(), 99, 70);
        // The camera is so close that tiles are narrower than voxels.
        const glm::dvec3 voxel = glm::dvec3(oracle::mortonDecode(codes.front())) + 0.5;
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
        std::vector<gpu::Ray> rays;
        for (int i = 0; i < 500; ++i)
        {
            rays.push_back(test::deviceRay(test::pickRay(random, octree.grid.rootResolution(), codes)));
        }
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
