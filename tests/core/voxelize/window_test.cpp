// SPDX-License-Identifier: MIT
#include "voxelize/window.h"

#include <gtest/gtest.h>

#include <array>

namespace zvo
{
namespace
{

struct Window
{
    gpu::uint grid_depth;
    gpu::uint cube_depth;
    gpu::uvec3 index;
};

constexpr gpu::uint kDepthLimit = (1U << gpu::kWindowDepthBits) - 1;
constexpr gpu::uint kIndexLimit = (1U << gpu::kWindowIndexBits) - 1;

TEST(Window, ComesBackAtTheLimitsOfEachField)
{
    const std::array windows = {
        Window{0, 0, {0, 0, 0}},
        Window{kDepthLimit, 0, {0, 0, 0}},
        Window{0, kDepthLimit, {0, 0, 0}},
        Window{0, 0, {kIndexLimit, 0, 0}},
        Window{0, 0, {0, kIndexLimit, 0}},
        Window{0, 0, {0, 0, kIndexLimit}},
        Window{kDepthLimit, kDepthLimit, {kIndexLimit, kIndexLimit, kIndexLimit}},
        Window{17, 10, {1, 64, 127}},
    };
    for (const Window& window : windows)
    {
        const gpu::uint word = gpu::packWindow(window.grid_depth, window.cube_depth, window.index);
        EXPECT_EQ(gpu::windowGridDepth(word), window.grid_depth) << word;
        EXPECT_EQ(gpu::windowCubeDepth(word), window.cube_depth) << word;
        EXPECT_EQ(gpu::windowIndex(word), window.index) << word;
    }
}

TEST(Window, HasItsFieldsInTheOrderOfTheDiagram)
{
    EXPECT_EQ(gpu::packWindow(1, 0, {0, 0, 0}), 1U);
    EXPECT_EQ(gpu::packWindow(0, 1, {0, 0, 0}), 1U << 5);
    EXPECT_EQ(gpu::packWindow(0, 0, {1, 0, 0}), 1U << 10);
    EXPECT_EQ(gpu::packWindow(0, 0, {0, 1, 0}), 1U << 17);
    EXPECT_EQ(gpu::packWindow(0, 0, {0, 0, 1}), 1U << 24);
}

} // namespace
} // namespace zvo
