// SPDX-License-Identifier: MIT
// A DAG looks like the octree that it was made from.
#include "core/headless/pipeline.h"
#include "core/trace/trace.h"
#include "io/gltf/gltf_loader.h"
#include "oracle/morton.h"
#include "support/dags.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"
#include "trace/node_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <random>
#include <string>
#include <utility>

namespace zvo
{
namespace
{

using test::hitCount;
using test::Picture;
using test::takePicture;

constexpr std::array kDagViews = {View::Color,      View::Albedo, View::Normal, View::Depth, View::Level,
                                  View::Iterations, View::Voxel,  View::Bricks, View::Origin};

using test::device;

/// An octree and its DAG.
struct Pair
{
    test::Codes codes;
    DeviceTree octree;
    oracle::ReferenceDag reference;
    DeviceTree dag;

    Pair(const test::Codes& voxels, std::uint32_t depth, bool attributes = true)
        : codes(voxels), octree(test::octreeOf(device(), voxels, depth))
    {
        if (attributes)
        {
            test::addAttributes(device(), octree);
        }
        reference = test::referenceDagOf(device(), octree);
        dag = test::svdagOf(device(), octree, reference);
    }
};

// Sets of voxels that share much or little, with one or several levels of nodes.
std::vector<std::pair<std::uint32_t, test::Codes>> codeSets()
{
    std::mt19937 random(31);
    const auto everywhere = [](const glm::uvec3&) { return true; };
    const auto checkered = [](const glm::uvec3& voxel) { return (voxel.x + voxel.y + voxel.z) % 2 == 0; };
    return {
        {1, {0, 5}},
        {2, test::randomCodes(2, 20, random)},
        {3, test::codesWhere(3, everywhere)},
        {5, test::codesWhere(5, checkered)},
        {6, test::sphereShell(6, 24.0)},
        {7, test::randomCodes(7, 3000, random)},
        {8, test::spongeCodes(8)},
        {11, test::randomCodes(11, 20000, random)},
    };
}

bool showsAttributes(View view)
{
    return view == View::Color || view == View::Albedo || view == View::Normal || view == View::Bricks ||
           view == View::Origin;
}

// with_index: hits have the indices of their attributes.
void expectSameHits(const std::vector<gpu::Hit>& expected, const std::vector<gpu::Hit>& hits,
                    const oracle::ReferenceDag& reference, std::uint32_t levels, bool with_index)
{
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        ASSERT_EQ(hits[i].index == gpu::kHitMiss, expected[i].index == gpu::kHitMiss) << i;
        if (hits[i].index == gpu::kHitMiss)
        {
            continue;
        }
        ASSERT_EQ(std::bit_cast<std::uint32_t>(hits[i].t), std::bit_cast<std::uint32_t>(expected[i].t)) << i;
        ASSERT_EQ(hits[i].where, expected[i].where) << i;
        if (with_index)
        {
            const bool is_voxel = test::unpack(hits[i])->level == levels;
            ASSERT_EQ(is_voxel ? hits[i].index : reference.depth_first.at(hits[i].index), expected[i].index) << i;
        }
    }
}

// Compares pictures of both trees.
void expectSamePictures(const DeviceTree& octree, const DeviceTree& dag, const oracle::ReferenceDag& reference,
                        const TraceCamera& camera, std::uint32_t width, std::uint32_t height,
                        const TraceOptions& options, bool must_hit, bool table = true)
{
    NodePaths octree_paths(device().device());
    TraceBuffers expected_buffers(device().device(), width, height);
    const Picture expected = takePicture(device(), octree, octree_paths, camera, expected_buffers, options);
    NodePaths paths(device().device(), table);
    TraceBuffers buffers(device().device(), width, height);
    const Picture picture = takePicture(device(), dag, paths, camera, buffers, options);
    EXPECT_EQ(picture.image, expected.image);
    EXPECT_EQ(picture.light, expected.light);
    EXPECT_EQ(picture.live_tiles, expected.live_tiles);
    EXPECT_EQ(device().download(buffers.starts), device().download(expected_buffers.starts));
    EXPECT_EQ(picture.capped_rays, expected.capped_rays);
    const bool with_index = octree.hasAttributes() && showsAttributes(options.view);
    ASSERT_NO_FATAL_FAILURE(
        expectSameHits(expected.hits, picture.hits, reference, octree.grid.nodeLevels(), with_index));
    if (must_hit)
    {
        EXPECT_GT(hitCount(expected), 0U);
    }
}

void expectSamePictures(const Pair& pair, const ViewCamera& view, std::uint32_t width, std::uint32_t height,
                        const TraceOptions& options, bool must_hit, bool table = true)
{
    SCOPED_TRACE("depth " + std::to_string(pair.octree.grid.depth));
    expectSamePictures(pair.octree, pair.dag, pair.reference, traceCamera(view, pair.octree.grid, height), width,
                       height, options, must_hit, table);
}

void expectSameRays(const DeviceTree& octree, const DeviceTree& dag, const oracle::ReferenceDag& reference,
                    const std::vector<gpu::Ray>& rays, const TraceOptions& options)
{
    SCOPED_TRACE("depth " + std::to_string(octree.grid.depth));
    expectSameHits(test::traceOnDevice(device(), octree, rays, options),
                   test::traceOnDevice(device(), dag, rays, options), reference, octree.grid.nodeLevels(), true);
}

std::vector<gpu::Ray> pickRays(const test::Codes& codes, std::uint32_t resolution, std::uint32_t count)
{
    std::mt19937 random(resolution + count);
    std::vector<gpu::Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        rays.push_back(test::deviceRay(test::pickRay(random, resolution, codes)));
    }
    return rays;
}

TEST(TraceSvdag, UploadedDagIsTheOctree)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const Pair pair(codes, depth);
        EXPECT_LE(pair.dag.node_count, pair.octree.node_count);
        const oracle::DagContents contents = test::dagContentsOf(device(), pair.dag);
        EXPECT_EQ(contents.violations, std::vector<std::string>{});
        ASSERT_EQ(contents.voxels.size(), codes.size());
        for (std::size_t i = 0; i < codes.size(); ++i)
        {
            ASSERT_EQ(contents.voxels[i].code, codes[i]);
            ASSERT_EQ(contents.voxels[i].rank, i);
        }
    }
}

TEST(TraceSvdag, EveryViewIsTheSame)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const Pair pair(codes, depth);
        const ViewCamera view = test::manyCameras(pair.octree.grid).front();
        for (const View shown : kDagViews)
        {
            TraceOptions options;
            options.view = shown;
            options.occlusion_rays = 2;
            expectSamePictures(pair, view, 99, 70, options, true);
        }
    }
}

TEST(TraceSvdag, EveryViewWithoutAttributesIsTheSame)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const Pair pair(codes, depth, false);
        const ViewCamera view = test::manyCameras(pair.octree.grid).front();
        for (const View shown : kDagViews)
        {
            TraceOptions options;
            options.view = shown;
            options.occlusion_rays = 2;
            expectSamePictures(pair, view, 53, 41, options, true);
        }
    }
}

TEST(TraceSvdag, EveryCameraSeesTheSameWithAndWithoutBeam)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const Pair pair(codes, depth);
        const std::vector<ViewCamera> views = test::manyCameras(pair.octree.grid);
        for (std::size_t i = 0; i < views.size(); ++i)
        {
            TraceOptions options;
            options.beam = i % 2 == 0;
            expectSamePictures(pair, views[i], 53, 41, options, i == 0, i % 4 < 2);
            options.view = View::Iterations;
            expectSamePictures(pair, views[i], 53, 41, options, i == 0);
        }
    }
}

TEST(TraceSvdag, AnyEntriesAWordGiveTheSame)
{
    for (const auto& [depth, codes] : codeSets())
    {
        DeviceTree octree = test::octreeOf(device(), codes, depth);
        test::addAttributes(device(), octree);
        const std::vector<ViewCamera> views = test::manyCameras(octree.grid);
        for (const std::uint32_t entries : {2U, 3U})
        {
            const oracle::ReferenceDag reference = test::referenceDagOf(device(), octree, entries);
            const DeviceTree dag = test::svdagOf(device(), octree, reference);
            for (const bool table : {true, false})
            {
                const TraceCamera camera = traceCamera(views[entries], octree.grid, 41);
                expectSamePictures(octree, dag, reference, camera, 53, 41, {}, false, table);
                expectSamePictures(octree, dag, reference, traceCamera(views.front(), octree.grid, 41), 53, 41, {},
                                   true, table);
            }
        }
    }
}

TEST(TraceSvdag, LevelsOfDetailStopAtTheSameNodes)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const Pair pair(codes, depth);
        const std::vector<ViewCamera> views = test::manyCameras(pair.octree.grid);
        for (const std::uint32_t level : {0U, 1U, 2U, 3U, 4U, 5U, UINT32_MAX})
        {
            for (const View shown : {View::Color, View::Level})
            {
                TraceOptions options;
                options.view = shown;
                options.detail_level = level;
                options.detail_pixels = level == UINT32_MAX ? 6.0F : 0.0F;
                expectSamePictures(pair, views.front(), 99, 70, options, true);
                expectSamePictures(pair, views.back(), 53, 41, options, false);
            }
        }
    }
}

TEST(TraceSvdag, RaysHitTheSame)
{
    for (const auto& [depth, codes] : codeSets())
    {
        const Pair pair(codes, depth);
        const std::vector<gpu::Ray> rays = pickRays(codes, pair.octree.grid.rootResolution(), 2049);
        TraceOptions options;
        expectSameRays(pair.octree, pair.dag, pair.reference, rays, options);
        options.detail_level = 2;
        expectSameRays(pair.octree, pair.dag, pair.reference, rays, options);
        test::expectEqualsReference(device(), pair.dag, codes, 500);
    }
}

TEST(TraceSvdag, EveryDepthIsTheSame)
{
    std::mt19937 random(32);
    for (std::uint32_t depth = 1; depth <= Grid::kDepthMax; ++depth)
    {
        const test::Codes codes = test::randomCodes(depth, 300, random);
        const Pair pair(codes, depth);
        expectSameRays(pair.octree, pair.dag, pair.reference, pickRays(codes, pair.octree.grid.rootResolution(), 501),
                       {});
        for (const ViewCamera& view :
             {test::manyCameras(pair.octree.grid).front(), test::manyCameras(pair.octree.grid).back()})
        {
            expectSamePictures(pair, view, 53, 41, {}, false);
        }
    }
}

TEST(TraceSvdag, RaysResumeInFurtherRounds)
{
    std::mt19937 random(33);
    const Pair pair(test::randomCodes(9, 20000, random), 9);
    const std::vector<gpu::Ray> rays = pickRays(pair.codes, pair.octree.grid.rootResolution(), 2049);
    for (const std::uint32_t steps : {200U, 1000U})
    {
        TraceOptions options;
        options.iterations_max = steps;
        expectSameRays(pair.octree, pair.dag, pair.reference, rays, options);
        for (const ViewCamera& view : test::manyCameras(pair.octree.grid))
        {
            expectSamePictures(pair, view, 53, 41, options, false);
        }
    }
}

TEST(TraceSvdag, EmptyDagIsBackground)
{
    const Pair pair({}, 4);
    expectSamePictures(pair, test::manyCameras(pair.octree.grid).front(), 53, 41, {}, false);
    const gpu::Ray ray = {{1.5F, 1.5F, 0.5F}, 0.0F, {1e20F, 1e20F, 1.0F}, 4.0F};
    for (const gpu::Hit& hit : test::traceOnDevice(device(), pair.dag, {ray, ray}))
    {
        EXPECT_EQ(hit.index, gpu::kHitMiss);
    }
}

TEST(TraceSvdag, TablesNameTheNodesAndTheVoxelsBeforeThem)
{
    std::mt19937 random(34);
    for (const std::uint32_t depth : {7U, 8U, 9U, 12U})
    {
        const Pair pair(test::randomCodes(depth, 20000, random), depth);
        const std::uint32_t levels = pair.octree.grid.nodeLevels();
        NodePaths paths(device().device(), true);
        device().run([&](vk::FrameGraph& graph) { buildNodePaths(graph, pair.dag, paths); });
        const std::vector<uint64_t> cells = device().download(paths.cells);
        const std::vector<uint64_t> ranks = device().download(paths.cells, gpu::kRankTableFirst, gpu::kRankTableFirst);
        ASSERT_EQ(ranks.size(), gpu::kRankTableFirst);
        const std::uint32_t shift = 6 * (levels - gpu::kPathLevels);
        std::uint32_t present_count = 0;
        for (std::uint32_t i = 0; i < gpu::kPathCells * gpu::kPathCells * gpu::kPathCells; ++i)
        {
            const glm::uvec3 cell(i % gpu::kPathCells, i / gpu::kPathCells % gpu::kPathCells,
                                  i / gpu::kPathCells / gpu::kPathCells);
            const std::uint64_t code = oracle::mortonEncode(cell);
            const auto first = std::lower_bound(pair.codes.begin(), pair.codes.end(), code << shift);
            const bool present = first != pair.codes.end() && *first >> shift == code;
            ASSERT_EQ(cells[i] >> 32 != 0, present) << i;
            if (present)
            {
                ++present_count;
                ASSERT_EQ(ranks[i] >> 32, first - pair.codes.begin()) << i;
                if (levels > gpu::kPathLevels + 1) // leaves are not looked up
                {
                    ASSERT_EQ(ranks[i] & UINT32_MAX, cells[i] >> 32) << i;
                }
            }
            else
            {
                ASSERT_EQ(ranks[i], 0U) << i;
            }
        }
        EXPECT_GT(present_count, 1000U);
    }
}

class TraceSvdagScenes : public testing::TestWithParam<const char*>
{
};

INSTANTIATE_TEST_SUITE_P(Scenes, TraceSvdagScenes,
                         testing::Values("bunny.glb", "dragon.glb", "sponza.glb", "atrium.glb", "knot.glb"),
                         [](const auto& test_case)
                         {
                             const std::string name = test_case.param;
                             return name.substr(0, name.find('.'));
                         });

TEST_P(TraceSvdagScenes, LookTheSame)
{
    const auto path = test::findScene(GetParam());
    if (!path)
    {
        GTEST_SKIP() << GetParam() << " is not there";
    }
    const Scene scene = loadGltf(*path);
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    const Grid grid = Grid::around(scene.bounds(), 9);
    const DeviceTree octree = buildOctree(device(), gpu_scene, grid, {}).octree;
    const oracle::ReferenceDag reference = test::referenceDagOf(device(), octree);
    const DeviceTree dag = test::svdagOf(device(), octree, reference);
    EXPECT_LT(dag.geometryBytes(), octree.geometryBytes());
    const Bounds bounds = scene.bounds();
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    const glm::dvec3 edges = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
    ViewCamera flat = ViewCamera::lookAt(middle + 0.7 * edges, middle, 0.7);
    flat.orthographic = true;
    flat.half_height = 0.3 * edges.y;
    const ViewCamera cameras[] = {ViewCamera::framing(bounds, 1.5),
                                  ViewCamera::lookAt(middle + glm::dvec3(0.1, 0.2, 0.3) * edges, middle, 1.0), flat};
    for (const ViewCamera& view : cameras)
    {
        for (const View shown : kDagViews)
        {
            TraceOptions options;
            options.view = shown;
            expectSamePictures(octree, dag, reference, traceCamera(view, grid, 200), 300, 200, options, false);
        }
        TraceOptions coarse;
        coarse.detail_pixels = 5.0F;
        expectSamePictures(octree, dag, reference, traceCamera(view, grid, 200), 300, 200, coarse, false);
    }
    const test::Codes codes = voxelCodes(device(), octree);
    expectSameRays(octree, dag, reference, pickRays(codes, grid.rootResolution(), 100000), {});
}

} // namespace
} // namespace zvo
