// SPDX-License-Identifier: MIT
// Algebra of octrees against dense grids, and in deep grids against shallow ones; scripts/check-algebra has many more
// cases.
#include "core/base/morton.h"
#include "runtime/tree_algebra.h"
#include "runtime/trees.h"
#include "support/algebra_compare.h"
#include "support/engine_device.h"
#include "support/tree_samples.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace zvo
{

namespace
{

using test::device;

TEST(Algebra, RandomTreesAreThoseOfDenseGrids)
{
    for (std::uint32_t number = 0; number < 24; ++number)
    {
        std::mt19937 random(number);
        EXPECT_EQ(test::compareAlgebra(device(), random, 3 + number % 3), "") << number;
    }
}

// The voxels of a tree, all of which lie in the upper corner of its grid, counted from that corner's low end.
std::vector<std::uint64_t> cornerCodes(const DeviceTree& tree, std::uint32_t corner_depth)
{
    const std::uint32_t edge = 1U << corner_depth;
    std::vector<std::uint64_t> codes;
    forEachCell(downloadTree(device(), tree), [&](std::uint64_t code, bool /*on_surface*/)
                { codes.push_back(codeOfCell(cellOfCode(code) - (tree.grid.resolution() - edge))); });
    return codes;
}

// Keys of nodes take two words from depth 13 on.
TEST(Algebra, DeepGridsHaveTheSameVoxels)
{
    constexpr std::uint32_t kDepth = 5;
    constexpr std::uint32_t kDeep = 13;
    std::mt19937 random(7);
    std::vector<std::uint64_t> codes[2];
    for (std::uint64_t code = 0; code < 1U << (3 * kDepth); ++code)
    {
        const glm::uvec3 at = cellOfCode(code);
        const bool in_shell = glm::any(glm::equal(at % 11U, glm::uvec3(3)));
        for (std::vector<std::uint64_t>& list : codes)
        {
            if (in_shell ? random() % 8 != 0 : random() % 64 == 0)
            {
                list.push_back(code);
            }
        }
    }
    std::vector<std::vector<std::uint64_t>> results[2];
    for (const std::uint32_t depth : {kDepth, kDeep})
    {
        DeviceTree trees[2];
        for (int i = 0; i < 2; ++i)
        {
            std::vector<std::uint64_t> moved;
            for (const std::uint64_t code : codes[i])
            {
                moved.push_back(codeOfCell(cellOfCode(code) + ((1U << depth) - (1U << kDepth))));
            }
            trees[i] = uploadTree(device(), test::octreeOf(moved, depth));
        }
        for (const AlgebraInfo& info :
             {AlgebraInfo{.operation = TreeOperation::Unite}, AlgebraInfo{.operation = TreeOperation::Subtract},
              AlgebraInfo{.operation = TreeOperation::Keep, .least_voxels = 20}})
        {
            const DeviceTree* const second = info.operation < TreeOperation::Keep ? &trees[1] : nullptr;
            results[depth == kDeep ? 1 : 0].push_back(
                cornerCodes(applyAlgebra(device(), info, trees[0], second), kDepth));
        }
    }
    EXPECT_FALSE(results[0].back().empty());
    EXPECT_EQ(results[0], results[1]);
}

} // namespace
} // namespace zvo
