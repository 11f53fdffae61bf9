// SPDX-License-Identifier: MIT
// A DAG of a filled octree is the same tree: its cells, what rays hit, what questions find, and what files keep.
#include "core/file/tree_check.h"
#include "core/file/tree_stats.h"
#include "core/file/zvo_file.h"
#include "core/tree/tree_build.h"
#include "runtime/flatten.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/dag_compare.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/fill_compare.h"
#include "support/octree_contents.h"
#include "support/pictures.h"
#include "support/queries.h"
#include "support/scenes.h"
#include "support/tree_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

DeviceTree octreeOf(const Scene& scene, const Grid& grid, Fill fill = Fill::Solid, bool attributes = true)
{
    const GpuScene uploaded = uploadScene(device(), scene, attributes);
    return buildOctree(device(), uploaded, grid, {.attributes = attributes, .fill = fill}).octree;
}

DeviceTree dagOf(const DeviceTree& octree, const CompressOptions& options = {})
{
    return compress(device(), uploadTree(device(), downloadTree(device(), octree)), options).dag;
}

/// A filled octree and its DAG.
struct Pair
{
    explicit Pair(const Scene& scene, const Grid& grid, const CompressOptions& options = {}, bool attributes = true)
        : octree(octreeOf(scene, grid, Fill::Solid, attributes)), dag(dagOf(octree, options))
    {
    }

    DeviceTree octree;
    DeviceTree dag;
};

// A hollow ball with full nodes of several sizes.
Scene ball(const Grid& grid)
{
    const float half = static_cast<float>(grid.resolution()) / 2;
    return test::sphereScene(glm::vec3(half, half + 0.3F, half - 0.2F), 0.92F * half, 20);
}

Grid gridOf(std::uint32_t depth)
{
    return {glm::vec3(0), 1.0F, depth};
}

void expectSameTree(const Pair& trees)
{
    EXPECT_EQ(trees.dag.interior_count, trees.octree.interior_count);
    EXPECT_EQ(trees.dag.octreeNodeCount(), trees.octree.octreeNodeCount());
    EXPECT_EQ(test::difference(test::cellsOf(device(), trees.dag), test::cellsOf(device(), trees.octree)), "");
}

TEST(FilledSvdag, HasTheCellsOfTheOctree)
{
    std::mt19937 random(41);
    std::uint64_t interior = 0;
    for (int round = 0; round < 16; ++round)
    {
        SCOPED_TRACE(round);
        const Grid grid = gridOf(3 + static_cast<std::uint32_t>(round % 4));
        const Scene scene = round % 5 == 4 ? ball(grid) : test::tetrahedra(random, grid);
        const Pair trees(scene, grid, {.entries_per_word = std::array{0U, 2U, 3U}.at(round % 3)}, round % 8 != 7);
        if (trees.octree.node_count != 0)
        {
            expectSameTree(trees);
        }
        interior += trees.dag.interior_count;
    }
    EXPECT_GT(interior, 5000U);
    const Pair large(ball(gridOf(7)), gridOf(7));
    expectSameTree(large);
    EXPECT_LT(large.dag.node_count, large.octree.node_count);
}

// Equal nodes are one, those of the surface and full ones.
TEST(FilledSvdag, HasEachSubtreeOnce)
{
    const Pair trees(ball(gridOf(7)), gridOf(7));
    const TreeData dag = downloadTree(device(), trees.dag);
    const TreeStats stats = treeStats(dag);
    const TreeStats of_octree = treeStats(downloadTree(device(), trees.octree));
    std::uint64_t full = 0;
    for (std::size_t level = 0; level < dag.levels.size(); ++level)
    {
        EXPECT_EQ(dag.levels[level].node_count, stats.unique_per_level[level]) << level;
        EXPECT_EQ(dag.levels[level].node_count, of_octree.unique_per_level[level]) << level;
    }
    for (const gpu::Node& node : std::span(dag.nodes).first(dag.levels.back().first_node))
    {
        full += cellMask(node) == 0 ? 1 : 0;
    }
    EXPECT_EQ(full, 1U); // of 16^3 voxels
}

TEST(FilledSvdag, IsHitByRaysAsTheOctree)
{
    for (const std::uint32_t depth : {4U, 7U, 9U})
    {
        SCOPED_TRACE(depth);
        const Grid grid = gridOf(depth);
        const bool attributes = depth != 4;
        const Pair trees(ball(grid), grid, {.entries_per_word = depth == 7 ? 3U : 0U}, attributes);
        for (const bool rank_table : {true, false})
        {
            test::TreeComparison comparison(device(), trees.octree, trees.dag, {53, 41}, rank_table);
            const ViewCamera inside =
                ViewCamera::lookAt(glm::dvec3(grid.resolution()) * 0.4, glm::dvec3(grid.resolution()) * 0.6, 1.0);
            comparison.views(test::manyCameras(grid).front(), true);
            comparison.views(inside, true);
            comparison.detail(inside, true);
            comparison.cameras(3);
            comparison.rays(voxelCodes(device(), trees.octree));
        }
    }
}

TEST(FilledSvdag, AnswersQuestionsAsTheOctree)
{
    const Grid grid = gridOf(6);
    const Pair trees(ball(grid), grid);
    std::vector<std::uint64_t> cells;
    forEachCell(downloadTree(device(), trees.octree), [&](std::uint64_t code, bool) { cells.push_back(code); });
    std::mt19937 random(42);
    const test::Queries queries = test::pickQueries(random, grid, cells, 300);
    for (const QueryKind kind : test::kQueryKinds)
    {
        const std::vector<QueryAnswer> expected = test::askDevice(device(), trees.octree, queries.list(kind));
        const std::vector<QueryAnswer> answers = test::askDevice(device(), trees.dag, queries.list(kind));
        std::uint64_t found = 0;
        EXPECT_EQ(test::queryDifference(grid, cells, queries.list(kind), answers, &found), "");
        EXPECT_GT(found, 30U);
        for (std::size_t i = 0; i < answers.size(); ++i)
        {
            EXPECT_EQ(answers[i].color, expected[i].color) << i;
        }
    }
}

TEST(FilledSvdag, IsKeptInFilesAndExpandedAgain)
{
    for (const bool attributes : {true, false})
    {
        const Grid grid = gridOf(7);
        const Pair trees(ball(grid), grid, {}, attributes);
        const TreeData dag = downloadTree(device(), trees.dag);
        std::vector<std::byte> bytes;
        writeZvo(dag, [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
        const TreeData read = readZvo(bytes, "ball.zvo").tree;
        EXPECT_EQ(read.interior_count, trees.octree.interior_count);
        EXPECT_EQ(read.geometryBytes(), trees.dag.geometryBytes());
        EXPECT_EQ(read.rankBytes(), trees.dag.lists.rankBytes());
        const DeviceTree uploaded = uploadTree(device(), read);
        EXPECT_EQ(test::difference(device(), uploaded, trees.dag), "");
        const DeviceTree flat = uploadTree(device(), flattenTree(device(), uploaded));
        EXPECT_EQ(octreeSha256(device(), flat), octreeSha256(device(), trees.octree));
        // What the host's walks say of both.
        const TreeData octree = downloadTree(device(), trees.octree);
        std::vector<std::uint64_t> codes;
        std::vector<std::uint64_t> expected;
        forEachCell(dag,
                    [&](std::uint64_t code, bool on_surface) { codes.push_back(2 * code + (on_surface ? 1 : 0)); });
        forEachCell(octree,
                    [&](std::uint64_t code, bool on_surface) { expected.push_back(2 * code + (on_surface ? 1 : 0)); });
        EXPECT_EQ(codes, expected);
        EXPECT_EQ(voxelBox(dag)->min, voxelBox(octree)->min);
        EXPECT_EQ(voxelBox(dag)->max, voxelBox(octree)->max);
        EXPECT_TRUE(hasVoxel(dag, glm::ivec3(64)));
        EXPECT_FALSE(hasVoxel(dag, glm::ivec3(0)));
    }
}

// What a file of a filled DAG must not say.
TEST(FilledSvdag, IsCheckedInFiles)
{
    const Grid grid = gridOf(7);
    const Pair trees(ball(grid), grid);
    const TreeData sound = downloadTree(device(), trees.dag);
    ASSERT_EQ(checkTree(sound), std::nullopt);
    const auto expectFault = [&](const std::string& words, const auto& break_tree)
    {
        TreeData tree = sound;
        break_tree(tree);
        const std::optional<std::string> fault = checkTree(tree);
        ASSERT_TRUE(fault.has_value()) << words;
        EXPECT_NE(fault->find(words), std::string::npos) << *fault;
    };
    const auto full_node = [](TreeData& tree) -> gpu::Node&
    { return *std::ranges::find(tree.nodes, std::uint64_t{0}, cellMask); };
    expectFault("occupied cells' masks of", [](TreeData& tree) { tree.occupied.pop_back(); });
    expectFault("that are not occupied", [](TreeData& tree) { tree.occupied.front() = 0; });
    expectFault("node 0 has no children", [](TreeData& tree) { tree.nodes.front() = {}; });
    expectFault("has its lists at", [&](TreeData& tree) { full_node(tree).base_lo += 1; });
    expectFault("has its lists at", [&](TreeData& tree) { full_node(tree).base_lo &= ~gpu::kChildList; });
    expectFault("has its lists at", [&](TreeData& tree) { full_node(tree).mask_lo = 1; });
    expectFault("has no children", [](TreeData& tree) { tree.occupied.clear(); });
    expectFault("counts beside entry", [](TreeData& tree) { tree.before.back().voxels += 1; });
    expectFault("octree nodes, but", [](TreeData& tree) { tree.octree_node_count += 64; });
}

TEST(FilledSvdag, IsNotCompressedAgain)
{
    const Grid grid = gridOf(4);
    Pair trees(ball(grid), grid);
    EXPECT_NE(test::messageOf([&] { compress(device(), std::move(trees.dag)); }, ErrorCode::Usage).find("again"),
              std::string::npos);
}

} // namespace
} // namespace zvo
