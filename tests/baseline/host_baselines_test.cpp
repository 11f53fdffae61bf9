// SPDX-License-Identifier: MIT
// What runs on the host beside zvo: rays cell by cell, DAGs by a hash table, octrees in other orders.
#include "baseline/baseline_fixture.h"
#include "baseline/bit_grid.h"
#include "baseline/hash_dag.h"
#include "baseline/node_order.h"
#include "core/base/grid.h"
#include "core/base/morton.h"
#include "core/file/tree_stats.h"
#include "core/trace/trace.h"
#include "core/tree/tree_data.h"
#include "oracle/trace.h"
#include "runtime/trees.h"
#include "support/errors.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>
#include <set>
#include <vector>

namespace zvo::baseline
{
namespace
{

using test::baselineDevice;

// Ascending codes of cells, about one of `every`.
std::vector<std::uint64_t> randomCodes(std::uint32_t depth, unsigned every, std::mt19937& random)
{
    std::vector<std::uint64_t> codes;
    for (std::uint64_t code = 0; code < std::uint64_t{1} << 3 * depth; ++code)
    {
        if (random() % every == 0)
        {
            codes.push_back(code);
        }
    }
    return codes;
}

struct RandomRay
{
    glm::vec3 origin;
    glm::vec3 direction;
    float t_min;
};

// From around and inside of the root cube; some in a plane across an axis, some from planes of cells.
RandomRay randomRay(std::mt19937& random)
{
    std::uniform_real_distribution<float> place(0.5F, 2.5F);
    std::uniform_real_distribution<float> side(-1.0F, 1.0F);
    glm::vec3 origin(place(random), place(random), place(random));
    glm::vec3 direction(side(random), side(random), side(random));
    if (random() % 4 == 0)
    {
        direction[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 0.0F : -0.0F;
    }
    if (random() % 4 == 0)
    {
        origin = glm::round(origin * 16.0F) / 16.0F;
    }
    return {origin, direction, random() % 4 == 0 ? 0.3F : 0.0F};
}

TEST(BitGridRays, HitWhatTheOracleHits)
{
    std::mt19937 random(22);
    for (const std::uint32_t depth : {1U, 4U, 5U, 6U})
    {
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
        const std::vector<std::uint64_t> codes = randomCodes(depth, depth == 1 ? 2 : 40, random);
        const BitGrid bits(grid, codes);
        const oracle::VoxelTracer expected(codes, depth);
        int hit_count = 0;
        for (int i = 0; i < 20000; ++i)
        {
            const RandomRay ray = randomRay(random);
            const auto hit = bits.firstHit(ray.origin, ray.direction, ray.t_min);
            const auto oracle_hit = expected.trace(oracle::makeRay(ray.origin, ray.direction, ray.t_min));
            ASSERT_EQ(hit.has_value(), oracle_hit.has_value()) << "depth " << depth << ", ray " << i;
            if (hit)
            {
                ASSERT_EQ(*hit, (GridHit{oracle_hit->t, cellOfCode(oracle_hit->code)})) << depth << ", ray " << i;
                ++hit_count;
            }
        }
        EXPECT_GT(hit_count, 300);
    }
}

TEST(HashDags, HaveTheVoxelsAndTheFewestNodes)
{
    for (const std::uint32_t depth : {5U, 6U, 7U})
    {
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
        const float size = static_cast<float>(grid.resolution());
        const Scene scene = test::sphereScene(glm::vec3(0.5F * size), 0.4F * size, 24);
        const DeviceTree tree = buildOctree(baselineDevice(), uploadScene(baselineDevice(), scene, false), grid,
                                            {Coverage::Thin, false, {}})
                                    .octree;
        const std::vector<std::uint64_t> codes = voxelCodes(baselineDevice(), tree);
        const HashDag dag = hashDag(codes, depth);
        test::expectSameCodes(listCodes(dag), codes);
        EXPECT_EQ(dag.node_count, treeStats(downloadTree(baselineDevice(), tree)).binary_unique_count);
    }
}

TEST(HashDags, OfNothingAreEmpty)
{
    const HashDag dag = hashDag({}, 4);
    EXPECT_EQ(dag.node_count, 0U);
    EXPECT_TRUE(listCodes(dag).empty());
}

TEST(HilbertCurve, GoesFromNeighbourToNeighbour)
{
    for (const std::uint32_t depth : {1U, 2U, 4U})
    {
        const std::uint64_t count = std::uint64_t{1} << 3 * depth;
        std::vector<glm::ivec3> curve(count, glm::ivec3(-1));
        for (std::uint64_t code = 0; code < count; ++code)
        {
            const glm::uvec3 cell = cellOfCode(code);
            const std::uint64_t place = hilbertCode(cell, depth);
            ASSERT_LT(place, count);
            ASSERT_EQ(curve[place], glm::ivec3(-1)) << "two cells at one place";
            curve[place] = glm::ivec3(cell);
        }
        for (std::uint64_t i = 1; i < count; ++i)
        {
            const glm::ivec3 step = glm::abs(curve[i] - curve[i - 1]);
            ASSERT_EQ(step.x + step.y + step.z, 1) << "depth " << depth << ", place " << i;
        }
    }
}

std::vector<gpu::Hit> hitsOf(const DeviceTree& tree, const ViewCamera& view)
{
    TraceBuffers buffers(baselineDevice().device(), 96, 64);
    const NodePaths paths(baselineDevice().device());
    const TraceCamera camera = traceCamera(view, tree.grid, 64);
    baselineDevice().run([&](vk::FrameGraph& graph)
                         { tracePrimary(graph, tree, paths, camera, {.beam = false}, buffers); });
    std::vector<gpu::Hit> hits = baselineDevice().download(buffers.hits);
    for (gpu::Hit& hit : hits)
    {
        hit.index = hit.index == gpu::kHitMiss ? gpu::kHitMiss : 0; // numbers of voxels follow the order of leaves
    }
    return hits;
}

TEST(NodeOrders, HaveTheSameHits)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 7};
    const Scene scene = test::sphereScene(glm::vec3(60.0F), 50.0F, 24);
    const DeviceTree tree =
        buildOctree(baselineDevice(), uploadScene(baselineDevice(), scene, false), grid, {Coverage::Thin, false, {}})
            .octree;
    const TreeData morton = downloadTree(baselineDevice(), tree);
    std::set<std::vector<std::uint32_t>> bases; // of each order
    for (const NodeOrder order : {NodeOrder::Morton, NodeOrder::Hilbert, NodeOrder::Shuffled})
    {
        const TreeData ordered = inOrder(morton, order);
        std::vector<std::uint32_t> lower;
        std::ranges::transform(ordered.nodes, std::back_inserter(lower), &gpu::Node::base_lo);
        EXPECT_TRUE(bases.insert(lower).second) << "two orders are the same";
        ASSERT_EQ(ordered.nodes.size(), morton.nodes.size());
        const bool is_same =
            std::memcmp(ordered.nodes.data(), morton.nodes.data(), morton.nodes.size() * sizeof(gpu::Node)) == 0;
        EXPECT_EQ(is_same, order == NodeOrder::Morton);
        const DeviceTree uploaded = uploadTree(baselineDevice(), ordered);
        for (const ViewCamera& camera : test::fewCameras(scene.bounds()))
        {
            const std::vector<gpu::Hit> hits = hitsOf(uploaded, camera);
            const std::vector<gpu::Hit> expected = hitsOf(tree, camera);
            EXPECT_EQ(std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(gpu::Hit)), 0);
        }
    }
}

TEST(NodeOrders, TakeNothingElse)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 5};
    const Scene scene = test::sphereScene(glm::vec3(16.0F), 12.0F, 12);
    const DeviceTree tree =
        buildOctree(baselineDevice(), uploadScene(baselineDevice(), scene, true), grid, {Coverage::Thin, true, {}})
            .octree;
    const TreeData data = downloadTree(baselineDevice(), tree);
    EXPECT_FALSE(test::messageOf([&] { inOrder(data, NodeOrder::Hilbert); }, ErrorCode::Usage).empty());
}

} // namespace
} // namespace zvo::baseline
