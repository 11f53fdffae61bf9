// SPDX-License-Identifier: MIT
// A DAG looks like the octree that it was made from.
#include "core/trace/trace.h"
#include "core/trace/trace_loads.h"
#include "io/gltf/gltf_loader.h"
#include "oracle/morton.h"
#include "runtime/trees.h"
#include "support/dags.h"
#include "support/engine_device.h"
#include "support/param_names.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"
#include "support/trace_rays.h"
#include "support/tree_comparison.h"
#include "trace/node_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::TreeComparison;

/// An octree and its DAG.
struct Pair
{
    DeviceTree octree;
    DeviceTree dag;

    explicit Pair(const test::CodeSet& set, bool attributes = true, std::uint32_t entries_per_word = 0)
        : octree(test::octreeOf(device(), set.codes, set.depth))
    {
        if (attributes)
        {
            test::addAttributes(device(), octree);
        }
        dag = test::svdagOf(device(), octree, entries_per_word);
    }

    [[nodiscard]] TreeComparison comparison(bool rank_table = true) const
    {
        return {device(), octree, dag, {53, 41}, rank_table};
    }

    [[nodiscard]] ViewCamera view() const { return test::manyCameras(octree.grid).front(); }
};

// The sectors that a ray loads.
std::vector<gpu::uint> loadsOf(const DeviceTree& tree, const oracle::Ray& ray)
{
    const vk::BufferOf<gpu::Ray> rays = device().makeBuffer<gpu::Ray>("rays", std::vector{test::deviceRay(ray)});
    RayLoads loads(device().device(), 1);
    device().run([&](vk::FrameGraph& graph) { traceLoads(graph, tree, rays, loads); });
    const std::uint32_t count = device().download(loads.iterations).front() * (tree.isDag() ? 2 : 1);
    return device().download(loads.sectors, 0, count);
}

TEST(TraceSvdag, LoadsAreThoseOfTheNodesOnTheWayAndTheirEntries)
{
    // A ray through the lowest row: past a voxel in each of two equal leaves, to a third one. Sector 0 has the root and
    // two leaf words.
    test::CodeSet set{4, {}};
    for (const glm::uvec3& voxel : {glm::uvec3(0, 1, 0), glm::uvec3(4, 1, 0), glm::uvec3(8, 0, 0)})
    {
        set.codes.push_back(oracle::mortonEncode(voxel));
    }
    const Pair trees(set, false);
    const oracle::Ray ray = oracle::makeRay(glm::vec3(0.5F, 1.03F, 1.03F), {1.0F, 0.0F, 0.0F});
    using Sectors = std::vector<gpu::uint>;
    EXPECT_EQ(loadsOf(trees.octree, ray), (Sectors{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}));
    // The root's list begins sector 1. Where no list is asked, the entry is the first one.
    EXPECT_EQ(loadsOf(trees.dag, ray), (Sectors{0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}));
}

TEST(TraceSvdag, EveryViewIsTheSame)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        SCOPED_TRACE(set.depth);
        const Pair pair(set);
        pair.comparison().views(pair.view(), true);
    }
}

TEST(TraceSvdag, EveryViewWithoutAttributesIsTheSame)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        SCOPED_TRACE(set.depth);
        const Pair pair(set, false);
        pair.comparison().views(pair.view(), true);
    }
}

TEST(TraceSvdag, EveryCameraSeesTheSameWithAndWithoutBeam)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        SCOPED_TRACE(set.depth);
        const Pair pair(set);
        for (const bool rank_table : {false, true})
        {
            pair.comparison(rank_table).cameras(1);
        }
        TraceOptions options;
        options.view = View::Iterations;
        pair.comparison().cameras(1, options);
    }
}

TEST(TraceSvdag, AnyEntriesAWordGiveTheSame)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        for (const std::uint32_t entries : {2U, 3U})
        {
            SCOPED_TRACE(testing::Message() << "depth " << set.depth << ", " << entries << " entries");
            const Pair pair(set, true, entries);
            for (const bool rank_table : {true, false})
            {
                TreeComparison comparison = pair.comparison(rank_table);
                EXPECT_GT(comparison.picture(pair.view()), 0U);
                comparison.picture(test::manyCameras(pair.octree.grid).at(entries));
            }
        }
    }
}

TEST(TraceSvdag, LevelsOfDetailStopAtTheSameNodes)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        SCOPED_TRACE(set.depth);
        const Pair pair(set);
        TreeComparison comparison = pair.comparison();
        comparison.detail(pair.view(), true);
        comparison.detail(test::manyCameras(pair.octree.grid).back());
    }
}

TEST(TraceSvdag, RaysHitTheSame)
{
    for (const test::CodeSet& set : test::codeSets())
    {
        SCOPED_TRACE(set.depth);
        const Pair pair(set);
        pair.comparison().rays(set.codes, {}, 2049);
        test::expectEqualsReference(device(), pair.dag, set.codes, 500);
    }
}

TEST(TraceSvdag, EveryDepthIsTheSame)
{
    std::mt19937 random(32);
    for (std::uint32_t depth = 1; depth <= Grid::kDepthMax; ++depth)
    {
        SCOPED_TRACE(depth);
        const test::CodeSet set = {depth, test::randomCodes(depth, 300, random)};
        const Pair pair(set);
        TreeComparison comparison = pair.comparison();
        comparison.rays(set.codes);
        comparison.picture(pair.view());
        comparison.picture(test::manyCameras(pair.octree.grid).back());
    }
}

TEST(TraceSvdag, RaysResumeInFurtherRounds)
{
    std::mt19937 random(33);
    const test::CodeSet set = {9, test::randomCodes(9, 20000, random)};
    const Pair pair(set);
    for (const std::uint32_t steps : {200U, 1000U})
    {
        TraceOptions options;
        options.iterations_max = steps;
        pair.comparison().rays(set.codes, options);
        pair.comparison().cameras(1, options);
    }
}

TEST(TraceSvdag, EmptyDagIsBackground)
{
    const Pair pair({4, {}});
    pair.comparison().picture(pair.view());
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
        const test::Codes codes = test::randomCodes(depth, 20000, random);
        const Pair pair({depth, codes});
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
            const auto first = std::lower_bound(codes.begin(), codes.end(), code << shift);
            const bool present = first != codes.end() && *first >> shift == code;
            ASSERT_EQ(cells[i] >> 32 != 0, present) << i;
            if (present)
            {
                ++present_count;
                ASSERT_EQ(ranks[i] >> 32, first - codes.begin()) << i;
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

using TraceSvdagScenes = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Scenes, TraceSvdagScenes,
                         testing::Values("bunny.glb", "dragon.glb", "sponza.glb", "atrium.glb", "knot.glb"),
                         test::paramName<std::string>);

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
    const DeviceTree dag = test::svdagOf(device(), octree);
    EXPECT_LT(dag.geometryBytes(), octree.geometryBytes());
    const Bounds bounds = scene.bounds();
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    const glm::dvec3 edges = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
    ViewCamera flat = ViewCamera::lookAt(middle + 0.7 * edges, middle, 0.7);
    flat.orthographic = true;
    flat.half_height = 0.3 * edges.y;
    TreeComparison comparison(device(), octree, dag, {300, 200});
    for (const ViewCamera& view : {ViewCamera::framing(bounds, 1.5),
                                   ViewCamera::lookAt(middle + glm::dvec3(0.1, 0.2, 0.3) * edges, middle, 1.0), flat})
    {
        comparison.views(view);
        TraceOptions coarse;
        coarse.detail_pixels = 5.0F;
        comparison.picture(view, coarse);
    }
    comparison.rays(voxelCodes(device(), octree), {}, 100000);
}

} // namespace
} // namespace zvo
