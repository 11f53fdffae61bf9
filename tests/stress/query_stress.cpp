// SPDX-License-Identifier: MIT
// Asks octrees and DAGs a million questions of each kind, and compares the answers with what every voxel asked on its
// own says.
//
//   zvo_query_stress [--queries N] [--seed S]    N questions of each kind
#include "core/base/kernels.h"
#include "core/query/query_list.h"
#include "stress/program.h"
#include "support/dags.h"
#include "support/queries.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace zvo::stress
{

namespace
{

constexpr std::uint64_t kBatch = 1U << 14;

struct AskedTree
{
    const char* name;
    std::uint32_t depth;
    test::Codes codes;
};

std::vector<AskedTree> makeTrees()
{
    std::mt19937 random(12);
    return {{"random 64", 6, test::randomCodes(6, 1000, random)},
            {"shell 64", 6, test::sphereShell(6, 9.0)},
            {"random 128", 7, test::randomCodes(7, 1500, random)},
            {"random 256", 8, test::randomCodes(8, 2000, random)},
            {"random 131072", 17, test::randomCodes(17, 1000, random)}};
}

// Asks count questions of each kind, of the octree and of the DAG in turns. Returns whether all answers were right.
bool ask(vk::HeadlessDevice& device, const AskedTree& asked, std::uint64_t count, std::uint64_t seed)
{
    const DeviceTree octree = test::octreeOf(device, asked.codes, asked.depth);
    const DeviceTree dag = test::svdagOf(device, octree);
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    std::uint64_t found = 0;
    for (std::uint64_t first = 0; first < count; first += kBatch)
    {
        const test::Queries queries =
            test::pickQueries(random, octree.grid, asked.codes, std::min(kBatch, count - first));
        for (const QueryKind kind : test::kQueryKinds)
        {
            const DeviceTree& tree = (first / kBatch + static_cast<std::uint64_t>(kind)) % 2 == 0 ? octree : dag;
            const std::vector<QueryAnswer> answers = test::askDevice(device, tree, queries.list(kind));
            const std::string difference =
                test::queryDifference(tree.grid, asked.codes, queries.list(kind), answers, &found);
            if (!difference.empty())
            {
                fmt::print("WRONG: {}, {}, from {} on: {}\n", asked.name, tree.isDag() ? "DAG" : "octree", first,
                           difference);
                return false;
            }
        }
    }
    fmt::print("{}: {} questions of each kind, {} of all found a voxel\n", asked.name, count, found);
    return true;
}

bool run(std::uint64_t count, std::uint64_t seed)
{
    const std::vector<AskedTree> trees = makeTrees();
    bool is_right = true;
    for (const AskedTree& tree : trees)
    {
        is_right =
            ask(test::sharedDevice(zvoKernels()), tree, (count + trees.size() - 1) / trees.size(), seed) && is_right;
    }
    return is_right;
}

} // namespace

} // namespace zvo::stress

int main(int argc, char** argv)
{
    std::uint64_t count = 1000000;
    std::uint64_t seed = 1;
    CLI::App app("Questions to trees, device against every voxel asked on its own");
    app.add_option("--queries", count, "how many questions of each kind")->capture_default_str();
    app.add_option("--seed", seed, "another number, other questions")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return zvo::stress::runProgram("zvo_query_stress", [&] { return zvo::stress::run(count, seed); });
}
