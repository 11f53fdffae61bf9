// SPDX-License-Identifier: MIT
// Questions to trees through the API.
#include "api_scene.h"
#include "c_host.h"
#include "expect_usage.h"
#include "support/engine_device.h"
#include "support/queries.h"

#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::expectUsage;

// The answers of a host's tree.
template <typename AnyTree>
std::vector<QueryAnswer> ask(test::EmbeddingHost& host, AnyTree& tree, const QueryList& queries)
{
    std::optional<QueryBatch> batch;
    host.frame(
        [&](Recorder& recorder)
        {
            batch.emplace(recorder, tree, queries);
            EXPECT_FALSE(batch->isDone());
        });
    EXPECT_TRUE(batch->isDone());
    std::vector<QueryAnswer> answers(batch->size());
    batch->answers(0, answers);
    return answers;
}

bool areSame(const std::vector<QueryAnswer>& a, const std::vector<QueryAnswer>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(QueryAnswer)) == 0;
}

TEST(ApiQuery, AnswersAreThoseOfTheEngine)
{
    test::EmbeddingHost host;
    const test::HostModel scene(test::apiScene());
    const Model model = host.upload(scene.info());
    Tree tree = host.build(model, {.grid = test::apiGrid(5)});
    const DeviceTree octree = test::engineOctree(test::device(), test::apiScene(), test::apiGrid(5));
    std::mt19937 random(1);
    const test::Queries queries = test::pickQueries(random, octree.grid, voxelCodes(test::device(), octree), 300);
    for (const QueryKind kind : test::kQueryKinds)
    {
        const std::vector<QueryAnswer> expected = test::askDevice(test::device(), octree, queries.list(kind));
        EXPECT_TRUE(areSame(ask(host, tree, queries.list(kind)), expected)) << static_cast<std::uint32_t>(kind);
        EXPECT_TRUE(std::ranges::any_of(expected, [](const QueryAnswer& answer) { return answer.color != 0; }));
    }
    tree = host.compress(std::move(tree));
    const std::vector<QueryAnswer> expected = test::askDevice(test::device(), octree, std::span(queries.nearest));
    EXPECT_TRUE(areSame(ask(host, tree, std::span(queries.nearest)), expected));
    EXPECT_TRUE(ask(host, tree, std::span<const PointQuery>()).empty());
    const DynamicTreeInfo info = {.emission_scale = tree.info().emission_scale};
    auto dynamic = host.make<DynamicTree>(std::move(tree), info);
    host.edit(dynamic, {.action = BrushAction::Fill, .center = {2, 30, 2}, .radius = 0, .color = 0x123456});
    host.update(dynamic);
    const std::vector<NearestQuery> near = {{{2 * 256 + 7, 30 * 256 + 9, 2 * 256 - 5}}};
    const QueryAnswer found = ask(host, dynamic, std::span(near)).at(0);
    EXPECT_EQ(found.cell, (std::array<std::uint32_t, 3>{2, 30, 2}));
    EXPECT_EQ(found.numerator, 25);
    EXPECT_EQ(found.color, 0x123456U);
}

TEST(ApiQuery, WhatMakesNoSenseIsRefused)
{
    test::EmbeddingHost host;
    const test::HostModel scene(test::apiScene());
    const Model model = host.upload(scene.info());
    const Tree tree = host.build(model, {.grid = test::apiGrid(3)});
    const std::vector<PointQuery> points(3);
    std::vector<QueryAnswer> answers(3);
    std::optional<QueryBatch> batch;
    host.frame(
        [&](Recorder& recorder)
        {
            batch.emplace(recorder, tree, std::span(points));
            expectUsage([&] { batch->answers(0, answers); }, "frameDone");
            const std::span too_many(points.data(), (1U << 24) + 1);
            expectUsage([&] { QueryBatch(recorder, tree, too_many); }, "queries");
        });
    batch->answers(0, answers);
    expectUsage([&] { batch->answers(1, answers); }, "there are 3");
    host.lostFrame([&](Recorder& recorder) { batch.emplace(recorder, tree, std::span(points)); });
    expectUsage([&] { (void)batch->isDone(); }, "lost");
    QueryBatch other = std::move(*batch);
    expectUsage([&] { (void)batch->size(); }, "moved");
    expectUsage([] { (void)latticePosition({.voxel_size = 0}, {}); }, "voxel");
}

TEST(ApiQuery, PositionsAreRoundedDownToTheLattice)
{
    const GridInfo grid = {{1, -2, 3}, 0.5F, 4};
    EXPECT_EQ(latticePosition(grid, {1, -2, 3}), (LatticePosition{0, 0, 0}));
    EXPECT_EQ(latticePosition(grid, {1.5, -2.001, 3.0009}), (LatticePosition{256, -1, 0}));
    const LatticePosition beyond = latticePosition(grid, {1e30, -1e30, NAN});
    EXPECT_GT(beyond[0], 1 << 27);
    EXPECT_LT(beyond[1], -(1 << 27));
    EXPECT_GT(beyond[2], 1 << 27);
}

TEST(CApi, QuestionsHaveTheAnswersOfCpp)
{
    test::CEmbeddingHost host;
    ZvoModel* const model = host.uploadBox();
    ZvoTreeBuildInfo build_info = ZVO_TREE_BUILD_INFO_INIT;
    build_info.grid = {{-2, -2, -2}, 1, 4};
    ZvoTree* tree = host.build(model, build_info);
    const double world[3] = {-1.9, -1.9, -1.9};
    ZvoNearestQuery query = {{0, 0, 0}, UINT32_MAX};
    ASSERT_EQ(zvoLatticePosition(&build_info.grid, world, query.position), ZVO_OK);
    EXPECT_EQ(query.position[2], 25);
    ZvoQueryBatch* batch = nullptr;
    ZvoQueryBatch* dynamic_batch = nullptr;
    ZvoDynamicTree* dynamic = nullptr;
    const ZvoDynamicTreeInfo dynamic_info = ZVO_DYNAMIC_TREE_INFO_INIT;
    VkBool32 is_done = VK_TRUE;
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            EXPECT_EQ(zvoQueryBatchCreate(recorder, tree, 5, &query, 1, &batch), ZVO_ERROR_USAGE);
            EXPECT_EQ(zvoQueryBatchCreate(recorder, tree, ZVO_QUERY_KIND_NEAREST, &query, 1, &batch), ZVO_OK);
            EXPECT_EQ(zvoQueryBatchIsDone(batch, &is_done), ZVO_OK);
            EXPECT_EQ(is_done, VK_FALSE);
        });
    host.frame(
        [&](ZvoRecorder* recorder)
        {
            EXPECT_EQ(zvoDynamicTreeCreate(recorder, tree, &dynamic_info, &dynamic), ZVO_OK);
            EXPECT_EQ(zvoQueryBatchCreateDynamic(recorder, dynamic, ZVO_QUERY_KIND_NEAREST, &query, 1, &dynamic_batch),
                      ZVO_OK);
        });
    ZvoQueryAnswer answer{};
    ZvoQueryAnswer dynamic_answer{};
    EXPECT_EQ(zvoQueryBatchAnswers(batch, 0, 1, &answer), ZVO_OK);
    EXPECT_EQ(zvoQueryBatchAnswers(dynamic_batch, 0, 1, &dynamic_answer), ZVO_OK);
    EXPECT_EQ(answer.state, ZVO_QUERY_STATE_FOUND);
    EXPECT_GT(answer.numerator, 0);
    EXPECT_EQ(answer.denominator, 1);
    EXPECT_NE(answer.color, 0U);
    EXPECT_EQ(std::memcmp(&answer, &dynamic_answer, sizeof(answer)), 0);
    EXPECT_EQ(zvoQueryBatchAnswers(batch, 1, 1, &answer), ZVO_ERROR_USAGE);
    zvoQueryBatchDestroy(batch);
    zvoQueryBatchDestroy(dynamic_batch);
    zvoDynamicTreeDestroy(dynamic);
    zvoModelDestroy(model);
}

} // namespace
} // namespace zvo
