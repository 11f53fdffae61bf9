// SPDX-License-Identifier: MIT
// Compares filled trees with exact winding numbers: random closed soups, nested and self-intersecting surfaces, models.
// Then it removes triangles: what is wrong of a fill, as the table of docs/voxelization.md has it.
//
//   zvo_fill_stress [--soups N] [--seed S] [--no-models] [--holes]
#include "core/base/kernels.h"
#include "io/gltf/gltf_loader.h"
#include "stress/program.h"
#include "support/fill_compare.h"
#include "support/scenes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace zvo::stress
{

namespace
{

struct Options
{
    std::uint64_t soups = 10'000;
    std::uint32_t seed = 1;
    bool models = true;
    bool holes = false;
};

constexpr std::array<Fill, 3> kFills = {Fill::Solid, Fill::Parity, Fill::Robust};

constexpr std::array<std::pair<Fill, Shell>, 5> kForms = {{{Fill::Solid, Shell::Surface},
                                                           {Fill::Parity, Shell::Surface},
                                                           {Fill::Robust, Shell::Surface},
                                                           {Fill::Solid, Shell::None},
                                                           {Fill::Parity, Shell::None}}};

constexpr std::array<double, 4> kLost = {0.01, 0.05, 0.10, 0.30};            // shares of the triangles
constexpr std::array<double, 4> kWrongMost = {0.0001, 0.0002, 0.0005, 0.04}; // of the voxels inside, with Fill::Robust

const char* nameOf(Fill fill)
{
    return fill == Fill::Solid ? "solid" : fill == Fill::Parity ? "parity" : "robust";
}

// Returns whether there is no difference. may_be_open: a scene that is not closed is left out.
bool compare(vk::HeadlessDevice& device, const std::string& name, const Scene& scene, const Grid& grid,
             bool may_be_open)
{
    bool is_well = true;
    for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    {
        for (const auto& [fill, shell] : kForms)
        {
            const test::FillComparison found = test::compareFill(device, scene, grid, coverage, fill, shell);
            const std::string what = fmt::format("{} {}^3 {} {}{}", name, grid.resolution(),
                                                 coverage == Coverage::Thin ? "thin" : "conservative", nameOf(fill),
                                                 shell == Shell::None ? " without a shell" : "");
            if (!found.is_closed)
            {
                fmt::print("{}: not closed, left out\n", what);
                return may_be_open;
            }
            fmt::print("{}: {} inside, {} wrong{}\n", what, found.interior, found.wrong,
                       found.same_surface ? "" : ", another surface");
            std::fflush(stdout);
            is_well = is_well && found.wrong == 0 && found.same_surface;
        }
    }
    return is_well;
}

std::uint64_t compareSoups(vk::HeadlessDevice& device, const Options& options)
{
    std::mt19937 random(options.seed);
    std::uint64_t interior = 0;
    std::uint64_t differences = 0;
    for (std::uint64_t i = 0; i < options.soups; ++i)
    {
        const Grid grid = {glm::vec3(0), 1.0F, 3 + static_cast<std::uint32_t>(i % 4)};
        Scene soup = test::tetrahedra(random, grid);
        const Fill fill = kFills[i / 4 % kFills.size()];
        const bool has_holes = fill == Fill::Robust && i % 7 != 0;
        if (has_holes)
        {
            soup = test::withHoles(std::move(soup), random, 0.2);
        }
        const Shell shell = fill != Fill::Robust && i % 5 < 3 ? Shell::None : Shell::Surface;
        const test::FillComparison found =
            test::compareFill(device, soup, grid, i % 3 == 0 ? Coverage::Conservative : Coverage::Thin, fill, shell);
        interior += found.interior;
        if ((!found.is_closed && !has_holes) || found.wrong != 0 || !found.same_surface)
        {
            ++differences;
            fmt::print("soup {} of seed {}: {} wrong\n", i, options.seed, found.wrong);
        }
    }
    fmt::print("{} soups: {} voxels inside, {} soups with differences\n", options.soups, interior, differences);
    return differences;
}

// Prints what is wrong of a fill of the closed scene without some of its triangles, in percent of the voxels inside.
// Returns whether it is as little as it should be.
bool tellHoles(vk::HeadlessDevice& device, const std::string& name, const Scene& scene, const Grid& grid)
{
    bool is_well = true;
    for (std::size_t i = 0; i < kLost.size(); ++i)
    {
        std::mt19937 random(7);
        const Scene with_holes = test::withHoles(scene, random, kLost[i]);
        std::array<double, kFills.size()> wrong{};
        std::ranges::transform(kFills, wrong.begin(),
                               [&](Fill fill) { return test::wrongOfHoles(device, scene, with_holes, grid, fill); });
        fmt::print("{} {}^3 without {:g} %: wrong {:.3f} % solid, {:.3f} % parity, {:.3f} % robust\n", name,
                   grid.resolution(), 100 * kLost[i], 100 * wrong[0], 100 * wrong[1], 100 * wrong[2]);
        std::fflush(stdout);
        is_well = is_well && wrong[2] <= kWrongMost[i];
    }
    return is_well;
}

// The closed surface of point(u, v), which is periodic in both from 0 to 1.
template <typename Point> Scene tube(std::uint32_t steps, const Point& point)
{
    const auto at = [&](std::uint32_t u, std::uint32_t v)
    { return glm::vec3(point(static_cast<double>(u % steps) / steps, static_cast<double>(v % steps) / steps)); };
    std::vector<glm::vec3> corners;
    for (std::uint32_t u = 0; u < steps; ++u)
    {
        for (std::uint32_t v = 0; v < steps; ++v)
        {
            corners.insert(corners.end(), {at(u, v), at(u + 1, v), at(u + 1, v + 1)});
            corners.insert(corners.end(), {at(u, v), at(u + 1, v + 1), at(u, v + 1)});
        }
    }
    return test::triangleSoup(corners);
}

// A tube that goes around twice and through itself, as the neck of a Klein bottle goes through its side.
Scene knottedTube(double edge)
{
    return tube(96,
                [edge](double u, double v)
                {
                    const double around = 4 * std::numbers::pi * u;
                    const double turn = 2 * std::numbers::pi * v;
                    const double radius = 0.08 + 0.05 * std::cos(around / 2);
                    const double ring = 0.27 + 0.06 * std::cos(around / 2) + radius * std::cos(turn);
                    return edge * glm::dvec3(0.5 + ring * std::cos(around), 0.5 + radius * std::sin(turn),
                                             0.5 + ring * std::sin(around));
                });
}

// Spheres in spheres, every other one turned inside out.
Scene nestedSpheres(float edge)
{
    Scene all;
    for (std::uint32_t i = 0; i < 5; ++i)
    {
        Scene sphere = test::sphereScene(glm::vec3(0.5F * edge), (0.48F - 0.09F * static_cast<float>(i)) * edge, 24);
        for (Primitive& primitive : sphere.primitives)
        {
            for (glm::uvec3& triangle : primitive.triangles)
            {
                triangle = i % 2 == 1 ? glm::uvec3(triangle.x, triangle.z, triangle.y) : triangle;
            }
        }
        all.append(std::move(sphere));
    }
    return all;
}

bool tellHoles(vk::HeadlessDevice& device, const Options& options)
{
    const Grid grid = {glm::vec3(0), 1.0F, 7};
    bool is_well = tellHoles(device, "a tube through itself", knottedTube(grid.resolution()), grid);
    for (const char* const name : {"dragon.glb", "buddha_113k.glb", "asian_dragon_28k.glb"})
    {
        if (const auto path = options.models ? test::findScene(name) : std::nullopt)
        {
            const Scene scene = loadGltf(*path);
            is_well = tellHoles(device, name, scene, Grid::around(scene.bounds(), 7)) && is_well;
        }
    }
    return is_well;
}

bool run(const Options& options)
{
    vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
    if (options.holes)
    {
        return tellHoles(device, options);
    }
    bool is_well = compareSoups(device, options) == 0;
    for (const std::uint32_t depth : {6U, 8U})
    {
        const Grid grid = {glm::vec3(0), 1.0F, depth};
        const auto edge = static_cast<float>(grid.resolution());
        is_well = compare(device, "nested spheres", nestedSpheres(edge), grid, false) && is_well;
        is_well = compare(device, "a tube through itself", knottedTube(edge), grid, false) && is_well;
    }
    is_well = tellHoles(device, options) && is_well;
    for (const char* const name : {"dragon.glb", "bunny.glb", "buddha_113k.glb", "asian_dragon_28k.glb", "knot.glb"})
    {
        const auto path = options.models ? test::findScene(name) : std::nullopt;
        if (!path)
        {
            fmt::print("{}: left out\n", name);
            continue;
        }
        const Scene scene = loadGltf(*path);
        for (const std::uint32_t depth : {6U, 9U})
        {
            is_well = compare(device, name, scene, Grid::around(scene.bounds(), depth), true) && is_well;
        }
        Scene turned = scene;
        for (Instance& instance : turned.instances)
        {
            const float s = std::sqrt(0.5F); // by 45 degrees about z
            instance.transform = glm::mat4(s, s, 0, 0, -s, s, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) * instance.transform;
        }
        is_well =
            compare(device, std::string(name) + " turned", turned, Grid::around(turned.bounds(), 8), true) && is_well;
    }
    return is_well;
}

} // namespace
} // namespace zvo::stress

int main(int argc, char** argv)
{
    zvo::stress::Options options;
    CLI::App app("Filled trees, device against exact winding numbers");
    app.add_option("--soups", options.soups, "how many random closed soups")->capture_default_str();
    app.add_option("--seed", options.seed, "another number, other soups")->capture_default_str();
    app.add_flag("--holes", options.holes, "only what is wrong of surfaces with holes");
    app.add_flag("!--no-models", options.models, "without models");
    CLI11_PARSE(app, argc, argv);
    return zvo::stress::runProgram("zvo_fill_stress", [&] { return zvo::stress::run(options); });
}
