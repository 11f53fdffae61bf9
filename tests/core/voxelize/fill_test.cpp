// SPDX-License-Identifier: MIT
// What is inside closed surfaces, against exact winding numbers.
#include "core/base/morton.h"
#include "core/file/zvo_file.h"
#include "core/tree/tree_build.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/fill_compare.h"
#include "support/queries.h"
#include "support/same_bytes.h"
#include "support/scenes.h"
#include "support/trace_rays.h"

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

// Expects that the cells of a filled tree are those of the surface and those whose centres have a winding number.
// Returns how many are inside.
std::uint64_t expectFilled(const Scene& scene, const Grid& grid, Coverage coverage, Fill fill,
                           Shell shell = Shell::Surface)
{
    const test::FillComparison found = test::compareFill(device(), scene, grid, coverage, fill, shell);
    EXPECT_TRUE(found.is_closed);
    EXPECT_EQ(found.wrong, 0U);
    EXPECT_TRUE(found.same_surface);
    return found.interior;
}

TEST(Fill, OfSpheresIsWhatTheirWindingNumbersSay)
{
    for (const std::uint32_t depth : {3U, 5U, 6U})
    {
        const Grid grid = {glm::vec3(0), 1.0F, depth};
        const float half = static_cast<float>(grid.resolution()) / 2;
        const Scene scene = test::sphereScene(glm::vec3(half), 0.9F * half, 12);
        EXPECT_GT(expectFilled(scene, grid, Coverage::Thin, Fill::Solid), 0U);
    }
}

TEST(Fill, OfTetrahedraAnywhereIsWhatTheirWindingNumbersSay)
{
    std::mt19937 random(1);
    std::uint64_t interior = 0;
    for (int round = 0; round < 32; ++round)
    {
        const std::uint32_t depth = 3 + static_cast<std::uint32_t>(round % 4);
        const Grid grid = {glm::vec3(0), 1.0F, depth};
        interior +=
            expectFilled(test::tetrahedra(random, grid), grid, round % 3 == 0 ? Coverage::Conservative : Coverage::Thin,
                         round % 2 == 0 ? Fill::Solid : Fill::Parity);
    }
    EXPECT_GT(interior, 5000U);
}

// Closed, it is as solid; with triangles removed, as most rays and neighbours say.
TEST(Fill, OfSurfacesWithHolesIsWhatMostRaysSay)
{
    std::mt19937 random(2);
    std::uint64_t interior = 0;
    std::uint64_t undecided = 0;
    for (int round = 0; round < 10; ++round)
    {
        const Grid grid = {glm::vec3(0), 1.0F, 3 + static_cast<std::uint32_t>(round % 5)};
        const float half = static_cast<float>(grid.resolution()) / 2;
        Scene scene =
            round % 3 == 0 ? test::sphereScene(glm::vec3(half), 0.9F * half, 12) : test::tetrahedra(random, grid);
        scene = test::withHoles(std::move(scene), random, round % 4 == 0 ? 0.0 : 0.2);
        const test::FillComparison found = test::compareFill(
            device(), scene, grid, round % 2 == 0 ? Coverage::Conservative : Coverage::Thin, Fill::Robust);
        EXPECT_EQ(found.wrong, 0U) << round;
        EXPECT_TRUE(found.same_surface);
        interior += found.interior;
        undecided += found.undecided;
    }
    EXPECT_GT(interior, 5000U);
    EXPECT_GT(undecided, 100U);
}

// Without the shell, voxels of the surface are there if their centres are inside, also where these lie on triangles.
TEST(Fill, WithoutAShellIsWhatIsInside)
{
    std::mt19937 random(5);
    std::uint64_t interior = 0;
    for (int round = 0; round < 24; ++round)
    {
        SCOPED_TRACE(round);
        const Grid grid = {glm::vec3(0), 1.0F, 3 + static_cast<std::uint32_t>(round % 3)};
        const float half = static_cast<float>(grid.resolution()) / 2;
        const Scene scene =
            round % 8 == 7 ? test::sphereScene(glm::vec3(half), 0.9F * half, 12) : test::tetrahedra(random, grid);
        interior += expectFilled(scene, grid, round % 3 == 0 ? Coverage::Conservative : Coverage::Thin,
                                 round % 2 == 0 ? Fill::Solid : Fill::Parity, Shell::None);
    }
    EXPECT_GT(interior, 5000U);
}

// Sums of all voxels or of mixed ones, in both forms, and full nodes.
TEST(Fill, WithoutAShellHasTheSameAttributesByAnySums)
{
    const Grid grid = {glm::vec3(0), 1.0F, 6};
    const GpuScene scene = uploadScene(device(), test::sphereScene(glm::vec3(31, 32, 33), 29, 3), true);
    std::optional<std::string> expected;
    for (const bool mixed : {false, true})
    {
        for (const std::uint32_t planes : {1U, 4U})
        {
            VoxelizeCapacities capacities = VoxelizeCapacities::estimate(scene, grid, Coverage::Thin);
            capacities.fill_planes = planes;
            const BuildResult built = buildOctree(device(), scene, grid,
                                                  {.capacities = capacities,
                                                   .sum_form = SumForm{.int64 = false, .mixed = mixed},
                                                   .fill = Fill::Solid,
                                                   .shell = Shell::None});
            const std::string sha256 = octreeSha256(device(), built.octree);
            EXPECT_EQ(sha256, expected.value_or(sha256));
            expected = sha256;
        }
    }
}

TEST(Fill, WithoutAShellTakesAFillByWindingNumbers)
{
    const Grid grid = {glm::vec3(0), 1.0F, 4};
    const GpuScene scene = uploadScene(device(), test::sphereScene(glm::vec3(8), 6, 4), true);
    for (const Fill fill : {Fill::None, Fill::Robust})
    {
        EXPECT_NE(test::messageOf([&] { buildOctree(device(), scene, grid, {.fill = fill, .shell = Shell::None}); },
                                  ErrorCode::Usage)
                      .find("shell"),
                  std::string::npos);
    }
}

struct FilledBall
{
    Grid grid{glm::vec3(0), 1.0F, 7};
    BuildResult built;
    TreeData tree;
    std::vector<std::uint64_t> cells;
    std::vector<std::uint64_t> surface;
};

// A ball with full nodes, textured by nothing.
FilledBall filledBall()
{
    FilledBall ball;
    const GpuScene scene = uploadScene(device(), test::sphereScene(glm::vec3(60, 64, 66), 58, 16), true);
    ball.built = buildOctree(device(), scene, ball.grid, {.fill = Fill::Solid});
    ball.tree = downloadTree(device(), ball.built.octree);
    forEachCell(ball.tree,
                [&](std::uint64_t code, bool on_surface)
                {
                    ball.cells.push_back(code);
                    if (on_surface)
                    {
                        ball.surface.push_back(code);
                    }
                });
    return ball;
}

// Full nodes are hit where their voxels would be, from anywhere, and voxels on the surface keep their numbers.
TEST(Fill, IsHitByRaysAsTheSameVoxelsWithoutFullNodes)
{
    const FilledBall ball = filledBall();
    const DeviceTree explicit_tree = uploadTree(device(), octreeOfVoxels(ball.grid, ball.cells));
    EXPECT_LT(ball.built.octree.node_count, explicit_tree.node_count); // as there are full nodes
    std::mt19937 random(3);
    const std::vector<gpu::Ray> rays = test::pickRays(random, ball.grid.rootResolution(), ball.cells, 4000);
    const std::vector<gpu::Hit> hits = test::traceOnDevice(device(), ball.built.octree, rays);
    const std::vector<gpu::Hit> expected = test::traceOnDevice(device(), explicit_tree, rays);
    std::array<std::uint32_t, 2> counts{}; // of hits inside, on the surface
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
        const std::optional<test::DeviceHit> hit = test::unpack(hits[i]);
        const std::optional<test::DeviceHit> wanted = test::unpack(expected[i]);
        ASSERT_EQ(hit.has_value(), wanted.has_value()) << i;
        if (!hit)
        {
            continue;
        }
        ASSERT_EQ(hit->cell, wanted->cell) << i;
        ASSERT_EQ(hit->t, wanted->t) << i;
        ASSERT_EQ(hit->face, wanted->face) << i;
        const auto rank = std::ranges::lower_bound(ball.surface, codeOfCell(hit->cell));
        const bool on_surface = rank != ball.surface.end() && *rank == codeOfCell(hit->cell);
        const auto index = static_cast<std::uint32_t>(rank - ball.surface.begin());
        ASSERT_EQ(hit->index, on_surface ? index : gpu::kInteriorIndex) << i;
        ++counts.at(on_surface ? 1 : 0);
    }
    EXPECT_GT(counts[0], 100U);
    EXPECT_GT(counts[1], 100U);
}

TEST(Fill, AnswersQuestionsAsItsVoxels)
{
    FilledBall ball = filledBall();
    std::mt19937 random(4);
    const test::Queries queries = test::pickQueries(random, ball.grid, ball.cells, 300);
    for (const QueryKind kind :
         {QueryKind::Point, QueryKind::Ray, QueryKind::Box, QueryKind::Nearest, QueryKind::Sweep})
    {
        std::uint64_t found = 0;
        const std::vector<QueryAnswer> answers = test::askDevice(device(), ball.built.octree, queries.list(kind));
        EXPECT_EQ(test::queryDifference(ball.grid, ball.cells, queries.list(kind), answers, &found), "");
        EXPECT_GT(found, 30U);
    }
    // What is inside has the colour of the root.
    constexpr std::uint32_t kRootColor = 0x123456;
    DeviceTree& tree = ball.built.octree;
    device().run([&](vk::FrameGraph& graph) { graph.fill(tree.node_attributes, kRootColor); });
    std::uint32_t inside = 0;
    for (const QueryAnswer& answer : test::askDevice(device(), tree, queries.list(QueryKind::Point)))
    {
        const std::uint64_t code = codeOfCell({answer.cell[0], answer.cell[1], answer.cell[2]});
        if (answer.state == QueryState::Found && !std::ranges::binary_search(ball.surface, code))
        {
            ++inside;
            EXPECT_EQ(answer.color, kRootColor);
        }
    }
    EXPECT_GT(inside, 10U);
}

TEST(Fill, IsKeptInFiles)
{
    const FilledBall ball = filledBall();
    std::vector<std::byte> bytes;
    writeZvo(ball.tree, [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    const TreeData read = readZvo(bytes, "ball.zvo").tree;
    EXPECT_EQ(read.interior_count, ball.built.octree.interior_count);
    EXPECT_EQ(read.occupiedCount(), ball.cells.size());
    const DeviceTree uploaded = uploadTree(device(), read);
    EXPECT_EQ(octreeSha256(device(), uploaded), octreeSha256(device(), ball.built.octree));
}

} // namespace
} // namespace zvo
