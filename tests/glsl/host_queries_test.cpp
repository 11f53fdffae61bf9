// SPDX-License-Identifier: MIT
// Questions of a host's kernel by zvo/trace.glsl are answered as lists of them by zvo's own.
#include "core/query/query_list.h"
#include "glsl/host_device.h"
#include "glsl/host_trees.h"
#include "support/queries.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace zvo
{
namespace
{

using test::deviceOfHosts;

// The structs of tests/glsl/host/queries.comp.
struct Question
{
    LatticePosition low;
    LatticePosition high;
    LatticePosition motion;
    gpu::uint reach;
};

struct FoundVoxels
{
    std::array<gpu::Hit, 4> hits;
    std::int64_t squared_distance;
    gpu::ivec2 time;
    gpu::ivec3 position;
    gpu::vec3 color;
};

struct QueriesPush
{
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<Question> questions;
    gpu::Ptr<FoundVoxels> answers;
    gpu::uint count;
    gpu::uint padding = 0;
};

std::vector<FoundVoxels> askHost(const DeviceTree& tree, const std::vector<Question>& questions)
{
    const vk::BufferOf<gpu::TreeTable> table = test::tableOf(tree);
    const vk::BufferOf<Question> list = deviceOfHosts().makeBuffer("questions", std::span<const Question>(questions));
    vk::BufferOf<FoundVoxels> found(deviceOfHosts().device(), "found", questions.size());
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("host/queries");
            test::readTree(pass, tree);
            const QueriesPush push = {pass.read(table), pass.read(list), pass.write(found),
                                      static_cast<gpu::uint>(questions.size())};
            pass.dispatch(questions.size(), push);
        });
    return deviceOfHosts().download(found);
}

// Compares cell, face, index and colour of what a host has found with an answer.
void expectSame(const gpu::Hit& hit, const QueryAnswer& answer, bool has_attributes, std::size_t i)
{
    const std::optional<test::DeviceHit> met = test::unpack(hit);
    ASSERT_EQ(met.has_value(), answer.state == QueryState::Found) << i;
    if (met)
    {
        ASSERT_EQ(met->cell, glm::uvec3(answer.cell[0], answer.cell[1], answer.cell[2])) << i;
        ASSERT_EQ(met->face, answer.face) << i;
        ASSERT_TRUE(!has_attributes || met->index == answer.index) << i;
    }
}

void expectSameAnswers(const DeviceTree& tree, const test::Codes& codes, std::uint32_t seed)
{
    std::mt19937 random(seed);
    const test::Queries queries = test::pickQueries(random, tree.grid, codes, 1500);
    std::vector<Question> questions;
    test::Queries asked;
    for (std::size_t i = 0; i < queries.sweeps.size(); ++i)
    {
        const SweepQuery& sweep = queries.sweeps[i];
        questions.push_back({sweep.low, sweep.high, sweep.motion, queries.nearest[i].reach});
        asked.points.push_back({sweep.low});
        asked.boxes.push_back({sweep.low, sweep.high});
        asked.nearest.push_back({sweep.low, queries.nearest[i].reach});
        asked.sweeps.push_back(sweep);
    }
    const std::vector<FoundVoxels> found = askHost(tree, questions);
    constexpr std::array kKinds = {QueryKind::Point, QueryKind::Box, QueryKind::Nearest, QueryKind::Sweep};
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
    {
        const std::vector<QueryAnswer> answers = test::askDevice(deviceOfHosts(), tree, asked.list(kKinds.at(kind)));
        for (std::size_t i = 0; i < found.size(); ++i)
        {
            expectSame(found[i].hits.at(kind), answers[i], tree.hasAttributes(), i);
            if (answers[i].state == QueryState::Found && kKinds.at(kind) == QueryKind::Nearest)
            {
                ASSERT_EQ(found[i].squared_distance, answers[i].numerator) << i;
            }
            if (answers[i].state == QueryState::Found && kKinds.at(kind) == QueryKind::Sweep)
            {
                ASSERT_EQ(found[i].time, gpu::ivec2(answers[i].numerator, answers[i].denominator)) << i;
            }
        }
    }
}

TEST(HostGlsl, QuestionsAreAnsweredAsThoseInLists)
{
    std::mt19937 random(5);
    const test::CodeSet sparse = {7, test::randomCodes(7, 3000, random)};
    const test::CodeSet shell = {6, test::sphereShell(6, 20.0)};
    expectSameAnswers(test::octreeWith(sparse, AttributeFormat::Bytes8), sparse.codes, 1);
    expectSameAnswers(test::dagWith(sparse, AttributeFormat::Bytes4), sparse.codes, 2);
    expectSameAnswers(test::octreeWith(shell, AttributeFormat::None), shell.codes, 3);
    expectSameAnswers(test::dagWith(shell, AttributeFormat::Blocks), shell.codes, 4);
}

TEST(HostGlsl, PointsInWorldSpaceHaveTheLatticePositionBelow)
{
    const test::CodeSet set = {4, test::spongeCodes(4)};
    const DeviceTree octree = test::octreeWith(set, AttributeFormat::Bytes8);
    std::vector<Question> questions;
    for (const int at : {-257, -1, 0, 1, 255, 256, 4095, 100000})
    {
        questions.push_back({{at, 2 * at, -at}, {at, at, at}, {0, 0, 0}, 1});
    }
    const std::vector<FoundVoxels> found = askHost(octree, questions);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        const LatticePosition& low = questions[i].low;
        EXPECT_EQ(found[i].position, glm::ivec3(low[0], low[1], low[2]));
        EXPECT_EQ(latticePosition(octree.grid, (glm::dvec3(low[0], low[1], low[2]) + 0.5) / 256.0), low);
    }
}

} // namespace
} // namespace zvo
