// SPDX-License-Identifier: MIT
// check_coverage: compares the voxels of the device and the oracle for millions of triangles and whole meshes, in both
// coverages. Ends with 1 if anything differs.
#include "core/base/kernels.h"
#include "io/gltf/gltf_loader.h"
#include "stress/compare_coverage.h"
#include "stress/program.h"
#include "support/device.h"
#include "support/scenes.h"
#include "zvo/error.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

namespace zvo::stress
{
namespace
{

constexpr std::array<Coverage, 2> kCoverages{Coverage::Conservative, Coverage::Thin};

/// Percentage of all triangles by shape.
constexpr std::array<std::uint64_t, kShapeCount> kShares{19, 18, 17, 18, 17, 6, 2, 1, 2};

struct Options
{
    std::uint64_t triangles = 10'000'000;
    std::uint64_t seed = 1;
    std::string shape; // empty: all
    std::int64_t batch = -1;
    bool meshes = true;
    std::uint32_t mesh_depth = 0; // of the grids of meshes; 0: 9, of Sponza 8
};

const char* nameOf(Coverage coverage)
{
    return coverage == Coverage::Thin ? "thin" : "conservative";
}

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void printHeader(const char* first_column)
{
    fmt::print("{:<22} {:<12} {:>10} {:>9} {:>12} {:>12} {:>8} {:>11}\n", first_column, "coverage", "triangles",
               "dropped", "voxels", "fragments", "hidden", "differences");
}

void print(const std::string& name, Coverage coverage, const Tally& tally)
{
    fmt::print("{:<22} {:<12} {:>10} {:>9} {:>12} {:>12} {:>8} {:>11}\n", name, nameOf(coverage), tally.triangles,
               tally.dropped, tally.voxels, tally.fragments, tally.hidden, tally.differences);
    std::fflush(stdout);
}

/// [shape][coverage]
using Tallies = std::array<std::array<Tally, 2>, kShapeCount>;

void runBatch(vk::HeadlessDevice& device, const Options& options, Shape shape, std::uint64_t number,
              std::size_t count_max, Tallies& tallies)
{
    const Batch batch = makeBatch(options.seed, shape, number, count_max);
    for (std::size_t i = 0; i < kCoverages.size(); ++i)
    {
        const auto name = [&]
        {
            return fmt::format("--seed {} --shape {} --batch {}, {}", options.seed, nameOf(shape), number,
                               nameOf(kCoverages[i]));
        };
        Tally tally;
        try
        {
            tally = compareBatch(device, batch, kCoverages[i]);
        }
        catch (const Error& error)
        {
            throw Error(error.code(), fmt::format("{}: {}", name(), error.what()));
        }
        if (tally.differences != 0)
            fmt::print(stderr, "{} differences: {}\n", tally.differences, name());
        for (const std::string& finding : tally.findings)
            fmt::print(stderr, "  {}\n", finding);
        tallies[static_cast<std::size_t>(shape)][i].add(tally);
    }
}

/// Returns the number of differences.
std::uint64_t checkTriangles(vk::HeadlessDevice& device, const Options& options)
{
    Tallies tallies;
    std::array<std::uint64_t, kShapeCount> next{}; // [shape] number of the next batch
    const auto start = std::chrono::steady_clock::now();
    double told = 0;
    for (std::uint64_t done = 0; done < options.triangles;)
    {
        // The shape that is furthest behind its percentage.
        std::size_t shape = 0;
        for (std::size_t i = 0; i < kShapeCount; ++i)
        {
            const bool wanted = options.shape.empty() || options.shape == nameOf(static_cast<Shape>(i));
            const bool current = options.shape.empty() || options.shape == nameOf(static_cast<Shape>(shape));
            const auto behind = [&](std::size_t k) { return tallies[k][0].triangles * 100 / kShares[k]; };
            if (wanted && (!current || behind(i) < behind(shape)))
                shape = i;
        }
        const std::uint64_t before = tallies[shape][0].triangles;
        const std::uint64_t number = options.batch >= 0 ? static_cast<std::uint64_t>(options.batch) : next[shape]++;
        runBatch(device, options, static_cast<Shape>(shape), number, 1 << 20, tallies);
        done += options.batch >= 0 ? options.triangles : tallies[shape][0].triangles - before;
        if (secondsSince(start) > told + 30)
        {
            told = secondsSince(start);
            fmt::print(stderr, "{:.0f} s: {} triangles\n", told, done);
        }
    }
    printHeader("shape");
    std::array<Tally, 2> sums;
    for (std::size_t shape = 0; shape < kShapeCount; ++shape)
    {
        for (std::size_t i = 0; i < kCoverages.size(); ++i)
        {
            if (tallies[shape][i].triangles != 0)
                print(nameOf(static_cast<Shape>(shape)), kCoverages[i], tallies[shape][i]);
            sums[i].add(tallies[shape][i]);
        }
    }
    for (std::size_t i = 0; i < kCoverages.size(); ++i)
        print("all", kCoverages[i], sums[i]);
    fmt::print("{:.0f} s, seed {}\n", secondsSince(start), options.seed);
    return sums[0].differences + sums[1].differences;
}

/// Checks triangles whose vertices need rounding to the lattice, a fiftieth of all. Returns the number of differences.
std::uint64_t checkPlaced(vk::HeadlessDevice& device, const Options& options)
{
    std::array<Tally, 2> sums;
    for (std::uint64_t number = 0; sums[0].triangles < options.triangles / 50; ++number)
    {
        const PosedGpuScene placed = makePosedScene(options.seed, number);
        for (std::size_t i = 0; i < kCoverages.size(); ++i)
        {
            const Tally tally = compareScene(device, placed.scene, placed.grid, kCoverages[i]);
            if (tally.differences != 0)
                fmt::print(stderr, "{} differences: --seed {}, placed scene {}, {}\n", tally.differences, options.seed,
                           number, nameOf(kCoverages[i]));
            for (const std::string& finding : tally.findings)
                fmt::print(stderr, "  {}\n", finding);
            sums[i].add(tally);
        }
    }
    for (std::size_t i = 0; i < kCoverages.size(); ++i)
        print("placed at random", kCoverages[i], sums[i]);
    return sums[0].differences + sums[1].differences;
}

std::uint64_t checkMeshes(vk::HeadlessDevice& device, std::uint32_t depth)
{
    struct Mesh
    {
        const char* file;
        std::uint32_t depth;
    };
    printHeader("mesh");
    std::uint64_t differences = 0;
    for (const Mesh& mesh :
         {Mesh{"bunny.glb", 9}, Mesh{"dragon.glb", 9}, Mesh{"buddha_113k.glb", 9}, Mesh{"sponza.glb", 8}})
    {
        const auto path = test::findScene(mesh.file);
        if (!path)
        {
            fmt::print("{:<22} is not there: left out\n", mesh.file);
            continue;
        }
        const Scene scene = loadGltf(*path);
        const Grid grid = Grid::around(scene.bounds(), depth != 0 ? depth : mesh.depth);
        for (const Coverage coverage : kCoverages)
        {
            const Tally tally = compareScene(device, scene, grid, coverage);
            print(fmt::format("{} {}", mesh.file, grid.resolution()), coverage, tally);
            for (const std::string& finding : tally.findings)
                fmt::print(stderr, "  {}\n", finding);
            differences += tally.differences;
        }
    }
    return differences;
}

bool run(const Options& options)
{
    vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
    std::uint64_t differences = 0;
    if (options.triangles != 0)
        differences += checkTriangles(device, options);
    if (options.shape.empty())
        differences += checkPlaced(device, options);
    if (options.meshes)
        differences += checkMeshes(device, options.mesh_depth);
    fmt::print("{} differences\n", differences);
    return differences == 0;
}

} // namespace
} // namespace zvo::stress

int main(int argc, char** argv)
{
    zvo::stress::Options options;
    CLI::App app("Coverage of triangles and meshes, device against oracle");
    app.add_option("--triangles", options.triangles, "how many random triangles of all shapes")->capture_default_str();
    app.add_option("--seed", options.seed, "another number, other triangles")->capture_default_str();
    app.add_option("--shape", options.shape, "only this shape");
    app.add_option("--batch", options.batch, "only this batch of --shape, as a difference names it");
    app.add_option("--mesh-depth", options.mesh_depth, "of the grids of whole meshes, up to 11");
    app.add_flag("!--no-meshes", options.meshes, "without whole meshes");
    CLI11_PARSE(app, argc, argv);
    return zvo::stress::runProgram("check_coverage", [&] { return zvo::stress::run(options); });
}
