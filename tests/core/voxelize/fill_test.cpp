// SPDX-License-Identifier: MIT
// What is inside closed surfaces, against exact winding numbers.
#include "core/base/morton.h"
#include "core/file/zvo_file.h"
#include "core/tree/tree_build.h"
#include "io/gltf/gltf_loader.h"
#include "oracle/snap.h"
#include "oracle/winding.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
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
#include <vector>

namespace zvo
{
namespace
{

using test::device;

// The triangles of a scene on the lattice.
std::vector<oracle::Triangle> latticeTriangles(const Scene& scene, const Grid& grid)
{
    std::vector<oracle::Triangle> triangles;
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const glm::uvec3& corners : primitive.triangles)
        {
            const auto& at = primitive.positions;
            const std::array<glm::vec3, 3> points = {at[corners.x], at[corners.y], at[corners.z]};
            triangles.push_back(
                oracle::snapTriangle(points, instance.transform, grid, Coverage::Conservative).triangle);
        }
    }
    return triangles;
}

// Expects that the cells of a filled tree are those of the surface and those whose centres have a winding number.
// Returns how many are inside.
std::uint64_t expectFilled(const Scene& scene, const Grid& grid, Coverage coverage, Fill fill)
{
    const std::vector<oracle::Triangle> triangles = latticeTriangles(scene, grid);
    EXPECT_TRUE(oracle::isClosed(triangles));
    const std::vector<std::int16_t> winding = oracle::windingNumbers(triangles, grid.resolution());
    const GpuScene uploaded = uploadScene(device(), scene, true);
    const BuildResult surface = buildOctree(device(), uploaded, grid, {.coverage = coverage});
    const BuildResult filled = buildOctree(device(), uploaded, grid, {.coverage = coverage, .fill = fill});
    const TreeData tree = downloadTree(device(), filled.octree);
    std::vector<std::uint64_t> on_surface;
    std::vector<bool> occupied(winding.size());
    std::uint64_t interior = 0;
    std::uint64_t wrong = 0;
    const std::size_t resolution = grid.resolution();
    const auto numberOf = [&](std::uint64_t code)
    {
        const glm::uvec3 cell = cellOfCode(code);
        return cell.x + resolution * (cell.y + resolution * cell.z);
    };
    const auto isInside = [&](std::size_t number)
    { return fill == Fill::Parity ? winding[number] % 2 != 0 : winding[number] != 0; };
    forEachCell(tree,
                [&](std::uint64_t code, bool is_surface)
                {
                    occupied[numberOf(code)] = true;
                    if (is_surface)
                    {
                        on_surface.push_back(code);
                        return;
                    }
                    ++interior;
                    wrong += isInside(numberOf(code)) ? 0 : 1;
                });
    for (std::size_t number = 0; number < winding.size(); ++number)
    {
        wrong += isInside(number) && !occupied[number] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_EQ(on_surface, voxelCodes(device(), surface.octree));
    EXPECT_TRUE(test::sameBytes(tree.voxel_attributes, downloadTree(device(), surface.octree).voxel_attributes));
    EXPECT_EQ(filled.octree.interior_count, interior);
    return interior;
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

// Closed soups of tetrahedra whose corners are a multiple of `step` lattice units, so that lines through voxels'
// centres meet edges, corners and planes.
TEST(Fill, OfTetrahedraAnywhereIsWhatTheirWindingNumbersSay)
{
    std::mt19937 random(1);
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    std::uint64_t interior = 0;
    for (int round = 0; round < 32; ++round)
    {
        const std::uint32_t depth = 3 + static_cast<std::uint32_t>(round % 4);
        const Grid grid = {glm::vec3(0), 1.0F, depth};
        const int step = std::array{1, 32, 64, 128, 256}[static_cast<std::size_t>(pick(0, 4))];
        const int top = static_cast<int>(256 * grid.resolution()) / step;
        std::vector<glm::vec3> corners;
        for (int solid = pick(1, 6); solid > 0; --solid)
        {
            std::array<glm::vec3, 4> points;
            for (glm::vec3& point : points)
            {
                point =
                    glm::vec3(pick(0, top - 1), pick(0, top - 1), pick(0, top - 1)) * static_cast<float>(step) / 256.0F;
            }
            for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
            {
                corners.insert(corners.end(),
                               {points.at(static_cast<std::size_t>(a)), points.at(static_cast<std::size_t>(b)),
                                points.at(static_cast<std::size_t>(c))});
            }
        }
        interior +=
            expectFilled(test::triangleSoup(corners), grid, round % 3 == 0 ? Coverage::Conservative : Coverage::Thin,
                         round % 2 == 0 ? Fill::Solid : Fill::Parity);
    }
    EXPECT_GT(interior, 5000U);
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
