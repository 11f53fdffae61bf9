// SPDX-License-Identifier: MIT
// An octree and a path-traced picture have the same bytes for all numbers of threads and sizes of subgroups. The
// software device reads both from the environment when a process starts.
#include "cli/run_zvo.h"
#include "support/param_names.h"
#include "support/scenes.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <initializer_list>
#include <set>
#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

struct Machine
{
    int threads;
    int vector_bits;
};

// Subgroups of 4, 8 and, where the processor has the registers, 16.
std::vector<Machine> machines()
{
    std::vector<Machine> all = {{0, 128}, {4, 128}, {0, 256}, {1, 256}, {2, 256}, {4, 256}};
    if (__builtin_cpu_supports("avx512f") != 0)
    {
        all.push_back({0, 512});
        all.push_back({4, 512});
    }
    return all;
}

Outcome runOn(const Machine& machine, const TempDir& dir, const CommandLine& arguments)
{
    std::vector<std::string> environment = vectorsOf(machine.vector_bits);
    environment.push_back("LP_NUM_THREADS=" + std::to_string(machine.threads));
    const Outcome outcome = runZvo(dir.path(), arguments, environment);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
}

struct DeterminismCase
{
    const char* scene;
    const char* resolution;
    const char* grid = nullptr; // origin and voxel size; null: the grid is around the scene
    const char* fill = "none";
};

void PrintTo(const DeterminismCase& octree, std::ostream* out)
{
    *out << octree.scene << " at " << octree.resolution;
}

std::string optionOf(Coverage coverage)
{
    return coverage == Coverage::Thin ? "thin" : "conservative";
}

class OctreeBytes : public testing::TestWithParam<std::tuple<DeterminismCase, Coverage>>
{
};

INSTANTIATE_TEST_SUITE_P(
    Scenes, OctreeBytes,
    testing::Combine(testing::Values(DeterminismCase{"atrium.glb", "256"},
                                     DeterminismCase{"bunny.glb", "256", nullptr, "solid"},
                                     DeterminismCase{"sponza.glb", "128"},
                                     DeterminismCase{"cornell_box.glb", "131072", "-99.1,-3.3,-0.2,0.002"}),
                     testing::Values(Coverage::Thin, Coverage::Conservative)),
    [](const auto& test_case)
    { return nameOf(std::get<0>(test_case.param).scene) + "_" + optionOf(std::get<1>(test_case.param)); });

TEST_P(OctreeBytes, DoNotDependOnThreadsAndSubgroups)
{
    const auto& [scene, coverage] = GetParam();
    const auto path = findScene(scene.scene);
    if (!path)
    {
        GTEST_SKIP() << scene.scene << " is not there";
    }
    CommandLine arguments = std::string("voxelize -o x.morton -f --json - --resolution ") + scene.resolution +
                            " --coverage " + optionOf(coverage) + " --fill " + scene.fill +
                            (scene.grid != nullptr ? std::string(" --grid=") + scene.grid : "");
    arguments.push_back(path->string());
    const TempDir dir;
    std::set<std::string> sums;
    std::set<int> vector_bits;
    std::set<int> subgroup_sizes;
    for (const Machine& machine : machines())
    {
        const Outcome outcome = runOn(machine, dir, arguments);
        const nlohmann::json report = nlohmann::json::parse(outcome.out);
        sums.insert(report.at("octree_sha256").get<std::string>());
        vector_bits.insert(machine.vector_bits);
        subgroup_sizes.insert(report.at("device").at("subgroup_size").get<int>());
        if (report.at("device").at("type") != "cpu")
        {
            GTEST_SKIP() << "only the software device takes its threads from the environment";
        }
    }
    EXPECT_EQ(sums.size(), 1U);
    EXPECT_EQ(subgroup_sizes.size(), vector_bits.size());
}

// The different pictures of a scene that is open to one side, by each machine and with each of options.
std::size_t countPictures(const std::string& arguments, std::initializer_list<const char*> options)
{
    const TempDir dir;
    std::set<std::string> pictures;
    for (const Machine& machine : machines())
    {
        for (const char* option : options)
        {
            CommandLine command = "render -o x.exr -f --resolution 64 --size 51x40 " + arguments + option;
            command.push_back(ownScene("cornell_box.glb").string());
            runOn(machine, dir, command);
            pictures.insert(contentOf(dir.path() / "x.exr"));
        }
    }
    return pictures.size();
}

// With light of voxels, sky and sun, and in both forms. The channels of --aov are in the file, and the picture is
// denoised.
TEST(PathBytes, DoNotDependOnThreadsSubgroupsAndForm)
{
    EXPECT_EQ(countPictures("--integrator path --spp 3 --denoise --aov --path-form ", {"stages", "kernel"}), 1U);
}

// More faces are wanted than a frame takes.
TEST(CachedBytes, DoNotDependOnThreadsSubgroupsAndLoads)
{
    EXPECT_EQ(countPictures("--integrator cache --settle 10 --spp 3 --rays 300 --tuning loads=",
                            {"addresses", "descriptors"}),
              1U);
}

} // namespace
} // namespace zvo::test
