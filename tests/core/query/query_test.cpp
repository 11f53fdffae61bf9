// SPDX-License-Identifier: MIT
// Questions to trees on the device against every voxel asked on its own.
#include "core/query/query_list.h"
#include "oracle/morton.h"
#include "support/dags.h"
#include "support/engine_device.h"
#include "support/queries.h"
#include "support/sweep.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

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

} // namespace
} // namespace zvo
