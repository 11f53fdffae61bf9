// SPDX-License-Identifier: MIT
// Questions to trees on the device against every voxel asked on its own.
#include "core/query/query_list.h"

#include "core/dynamic/dynamic_octree.h"
#include "core/tree/rgb9e5.h"
#include "oracle/morton.h"
#include "runtime/trees.h"
#include "support/dags.h"
#include "support/dynamic_updates.h"
#include "support/engine_device.h"
#include "support/octree_access.h"
#include "support/octree_contents.h"
#include "support/queries.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::askDevice;
using test::device;

// Asks an octree of codes and its DAG, and compares what they say.
void expectRight(const test::Codes& codes, std::uint32_t depth, std::size_t count, std::uint32_t seed)
{
    DeviceTree octree = test::octreeOf(device(), codes, depth);
    octree.grid.origin = {-3.7F, 12.25F, 0.3F};
    octree.grid.voxel_size = 0.37F;
    const DeviceTree dag = test::svdagOf(device(), octree);
    std::mt19937 random(seed);
    const test::Queries queries = test::pickQueries(random, octree.grid, codes, count);
    for (const QueryKind kind : test::kQueryKinds)
    {
        for (const DeviceTree& tree : {std::cref(octree), std::cref(dag)})
        {
            std::uint64_t found = 0;
            ASSERT_EQ(test::queryDifference(tree.grid, codes, queries.list(kind),
                                            askDevice(device(), tree, queries.list(kind)), &found),
                      "")
                << "depth " << depth;
            EXPECT_GT(found, count / 20) << static_cast<std::uint32_t>(kind);
        }
    }
}

TEST(Query, AnswersOfRandomVoxelsAreThoseOfEachVoxel)
{
    std::mt19937 random(1);
    for (const std::uint32_t depth : {2U, 5U, 8U})
    {
        expectRight(test::randomCodes(depth, depth < 4 ? 20 : 1000, random), depth, 1000, depth);
    }
}

TEST(Query, AnswersInDeepGridsAreThoseOfEachVoxel)
{
    std::mt19937 random(2);
    expectRight(test::randomCodes(17, 500, random), 17, 1000, 1);
}

TEST(Query, AnswersOfShellsSpongesAndFullGridsAreThoseOfEachVoxel)
{
    expectRight(test::sphereShell(5, 12.0), 5, 1000, 3);
    expectRight(test::spongeCodes(6), 6, 200, 4);
    expectRight(test::codesWhere(2, [](const glm::uvec3&) { return true; }), 2, 1000, 5);
}

// Voxels, colours and emission as a list of everything in a tree has them.
void expectLooks(const DeviceTree& tree, const std::vector<test::Cell>& cells, const std::vector<QueryAnswer>& answers)
{
    std::map<std::uint64_t, const test::Cell*> voxels;
    for (const test::Cell& cell : cells)
    {
        if (cell.level == tree.grid.nodeLevels())
        {
            voxels[cell.code] = &cell;
        }
    }
    for (const QueryAnswer& answer : answers)
    {
        if (answer.state == QueryState::Found)
        {
            const std::uint64_t code = oracle::mortonEncode({answer.cell[0], answer.cell[1], answer.cell[2]});
            ASSERT_TRUE(voxels.contains(code));
            ASSERT_EQ(answer.color, voxels[code]->attribute.color & 0xFFFFFFU);
            const glm::dvec3 normal = test::normalOf(voxels[code]->attribute);
            const glm::vec3 emission = tree.emission_scale * decodeRgb9e5(voxels[code]->emission);
            for (int axis = 0; axis < 3; ++axis)
            {
                const auto place = static_cast<std::size_t>(axis);
                ASSERT_NEAR(answer.normal.at(place), normal[axis], 1e-6);
                ASSERT_EQ(answer.emission.at(place), emission[axis]);
            }
        }
    }
}

// A dynamic octree above a tree, with a box and a dab in it, whose overlay has nodes as leaves.
TEST(Query, OverlaysAreAskedAsTheStaticTree)
{
    std::mt19937 random(6);
    DynamicOptions options;
    options.emission_scale = 1.0F;
    for (const bool compressed : {false, true})
    {
        DeviceTree octree = test::octreeOf(device(), test::randomCodes(6, 1500, random), 6);
        test::addAttributes(device(), octree);
        DynamicOctree dynamic(device(), compressed ? compress(device(), std::move(octree)).dag : std::move(octree),
                              options);
        const Scene box = test::boxScene(glm::vec3(0.0F), glm::vec3(17.3F));
        dynamic.add(uploadDynamicMesh(device(), box, true, 1.0F),
                    {{glm::translate(glm::mat4(1.0F), glm::vec3(13.1F, 20.2F, 9.9F))}, {}, {}});
        test::updateAll(device(), dynamic);
        test::runFrame(device(), dynamic,
                       [&](vk::FrameGraph& graph) {
                           dynamic.edit(graph, {.action = BrushAction::Fill, .center = {40, 40, 40}, .radius = 5});
                       });
        test::updateAll(device(), dynamic);
        const DeviceTree& tree = dynamic.tree();
        const std::vector<test::Cell> cells = test::cellsOf(device(), tree);
        test::Codes codes;
        for (const test::Cell& cell : cells)
        {
            if (cell.level == tree.grid.nodeLevels())
            {
                codes.push_back(cell.code);
            }
        }
        ASSERT_GT(codes.size(), 2500U);
        const test::Queries queries = test::pickQueries(random, tree.grid, codes, 500);
        for (const QueryKind kind : test::kQueryKinds)
        {
            std::uint64_t found = 0;
            const std::vector<QueryAnswer> answers = askDevice(device(), tree, queries.list(kind));
            ASSERT_EQ(test::queryDifference(tree.grid, codes, queries.list(kind), answers, &found), "");
            EXPECT_GT(found, 50U);
            expectLooks(tree, cells, answers);
        }
    }
}

TEST(Query, WalksThatTakeTooLongAreUndecided)
{
    const test::Codes codes = test::sphereShell(6, 25.0);
    const DeviceTree octree = test::octreeOf(device(), codes, 6);
    const DeviceTree dag = test::svdagOf(device(), octree);
    std::mt19937 random(7);
    const test::Queries queries = test::pickQueries(random, octree.grid, codes, 500);
    for (const DeviceTree& tree : {std::cref(octree), std::cref(dag)})
    {
        for (const QueryKind kind : {QueryKind::Box, QueryKind::Nearest, QueryKind::Sweep})
        {
            constexpr std::uint32_t kFew = 6;
            std::uint32_t undecided = 0;
            std::vector<QueryAnswer> answers = askDevice(device(), tree, queries.list(kind), &undecided, kFew);
            const std::vector<QueryAnswer> decided = askDevice(device(), tree, queries.list(kind));
            std::uint32_t count = 0;
            for (std::size_t i = 0; i < answers.size(); ++i)
            {
                if (answers[i].state == QueryState::Undecided)
                {
                    ++count;
                    EXPECT_EQ(answers[i].denominator, 0);
                    answers[i] = decided[i];
                }
            }
            EXPECT_EQ(count, undecided);
            EXPECT_GT(count, 10U);
            EXPECT_LT(count, answers.size());
            std::uint64_t found = 0;
            EXPECT_EQ(test::queryDifference(tree.grid, codes, queries.list(kind), answers, &found), "");
        }
    }
}

TEST(Query, ATreeWithoutVoxelsHasNone)
{
    const DeviceTree octree = test::octreeOf(device(), test::Codes{}, 5);
    const std::vector<NearestQuery> queries(27, NearestQuery{{1000, 2000, 3000}});
    for (const QueryAnswer& answer : askDevice(device(), octree, std::span(queries)))
    {
        EXPECT_EQ(answer.state, QueryState::Nothing);
    }
}

TEST(Query, DistancesAndTimesComeRounded)
{
    DeviceTree octree = test::octreeOf(device(), test::Codes{0}, 2);
    octree.grid.voxel_size = 0.5F;
    const std::vector<NearestQuery> nearest = {{{256 + 3, 256 + 4, 0}}};
    const QueryAnswer near = askDevice(device(), octree, std::span(nearest)).at(0);
    EXPECT_EQ(near.numerator, 25);
    EXPECT_EQ(near.t, 5.0F / 512);
    const std::vector<SweepQuery> sweeps = {{{300, 0, 0}, {400, 100, 100}, {-88, 0, 0}}};
    const QueryAnswer met = askDevice(device(), octree, std::span(sweeps)).at(0);
    EXPECT_EQ(met.face, 0U);
    EXPECT_EQ(met.t, 0.5F);
}

} // namespace
} // namespace zvo
