// SPDX-License-Identifier: MIT
// Compares operations on random trees with the same on dense grids.
//
//   zvo_algebra_stress [--cases N] [--seed S] [--depth D]
#include "core/base/kernels.h"
#include "stress/program.h"
#include "support/algebra_compare.h"
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
    std::uint64_t cases = 10'000;
    std::uint32_t seed = 1;
    std::uint32_t depth = 0; // of all cases; 0: 3 to 6, and now and then 7 and 8
};

std::uint32_t depthOf(std::uint64_t number, const Options& options)
{
    constexpr std::uint64_t kLargeEvery = 64;
    if (options.depth != 0)
    {
        return options.depth;
    }
    return number % kLargeEvery == kLargeEvery - 1 ? 7 + static_cast<std::uint32_t>(number / kLargeEvery % 2)
                                                   : 3 + static_cast<std::uint32_t>(number % 4);
}

bool run(const Options& options)
{
    vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
    std::uint64_t differences = 0;
    for (std::uint64_t number = 0; number < options.cases; ++number)
    {
        std::mt19937 random(options.seed * 1'000'003U + static_cast<std::uint32_t>(number));
        const std::uint32_t depth = depthOf(number, options);
        const std::string difference = test::compareAlgebra(device, random, depth);
        if (!difference.empty())
        {
            ++differences;
            fmt::print("case {} of seed {}, depth {}: {}\n", number, options.seed, depth, difference);
            std::fflush(stdout);
        }
    }
    fmt::print("{} cases: {} with differences\n", options.cases, differences);
    return differences == 0;
}

} // namespace
} // namespace zvo::stress

int main(int argc, char** argv)
{
    zvo::stress::Options options;
    CLI::App app("Algebra of octrees, device against dense grids");
    app.add_option("--cases", options.cases, "how many random cases")->capture_default_str();
    app.add_option("--seed", options.seed, "another number, other cases")->capture_default_str();
    app.add_option("--depth", options.depth, "of all trees, 3 to 9")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return zvo::stress::runProgram("zvo_algebra_stress", [&] { return zvo::stress::run(options); });
}
