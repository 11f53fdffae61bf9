// SPDX-License-Identifier: MIT
// Compares distances in a band with exact ones: random closed soups, triangles of any shape, models.
//
//   zvo_distance_stress [--soups N] [--seed S] [--no-models]
#include "core/base/kernels.h"
#include "io/gltf/gltf_loader.h"
#include "stress/program.h"
#include "support/distance_compare.h"
#include "support/fill_compare.h"
#include "support/scenes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

namespace zvo::stress
{

namespace
{

struct Options
{
    std::uint64_t soups = 1000;
    std::uint32_t seed = 1;
    bool models = true;
};

bool compare(vk::HeadlessDevice& device, const std::string& name, const Scene& scene, const Grid& grid,
             std::uint32_t band, Fill fill)
{
    const test::DistanceComparison found = test::compareDistances(device, scene, grid, {.band = band, .fill = fill});
    if (!found.isWell() || !name.starts_with("soup"))
    {
        fmt::print("{} {}^3, band {}: {} in it, {} inside, {} wrong values, {} wrong signs{}\n", name,
                   grid.resolution(), band, found.in_band, found.inside, found.wrong_values, found.wrong_signs,
                   found.is_closed ? "" : " (not closed)");
        std::fflush(stdout);
    }
    return found.isWell();
}

bool run(const Options& options)
{
    vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
    std::mt19937 random(options.seed);
    bool is_well = true;
    for (std::uint32_t i = 0; i < options.soups; ++i)
    {
        const Grid grid = {glm::vec3(0), 1.0F, 3 + i % 3};
        const bool is_closed = i % 2 == 0;
        const Scene soup =
            is_closed ? test::tetrahedra(random, grid) : test::randomTriangles(options.seed + i, 1 + i % 20, 1.2F * 8);
        is_well = compare(device, fmt::format("soup {} of seed {}", i, options.seed), soup, grid, 1 + i % 15,
                          i % 4 == 0 ? Fill::Parity : Fill::Solid) &&
                  is_well;
    }
    for (const char* const name :
         {"bunny_low.glb", "buddha_113k.glb", "asian_dragon_28k.glb", "knot.glb", "sponza.glb"})
    {
        if (const auto path = options.models ? test::findScene(name) : std::nullopt)
        {
            const Scene scene = loadGltf(*path);
            is_well = compare(device, name, scene, Grid::around(scene.bounds(), 6, 4), 3, Fill::Solid) && is_well;
        }
        else
        {
            fmt::print("{}: left out\n", name);
        }
    }
    return is_well;
}

} // namespace
} // namespace zvo::stress

int main(int argc, char** argv)
{
    zvo::stress::Options options;
    CLI::App app("Distances in a band, device against exact ones");
    app.add_option("--soups", options.soups, "how many random soups")->capture_default_str();
    app.add_option("--seed", options.seed, "another number, other soups")->capture_default_str();
    app.add_flag("!--no-models", options.models, "without models");
    CLI11_PARSE(app, argc, argv);
    return zvo::stress::runProgram("zvo_distance_stress", [&] { return zvo::stress::run(options); });
}
