// SPDX-License-Identifier: MIT
// The random numbers of samples: an Owen-scrambled Sobol sequence, whatever the order.
#include "core/light/kernels/light_test/choose.h"
#include "support/light_device.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::lightDevice;

std::vector<gpu::uvec2> samples(std::uint32_t count, std::uint32_t seed, std::uint32_t pair)
{
    vk::BufferOf<gpu::uvec2> buffer(lightDevice().device(), "samples", count);
    lightDevice().run(
        [&](vk::FrameGraph& graph)
        {
            vk::Pass pass = graph.addPass(gpu::light_test::Samples{});
            pass.dispatch(count, {pass.write(buffer), count, seed, pair});
        });
    return lightDevice().download(buffer);
}

// Of the first 2^n samples, one is in each elementary interval of area 2^-n: of every shape.
TEST(Samples, AreOneInEachElementaryInterval)
{
    for (const std::uint32_t seed : {0U, 1U, 0x12345678U})
    {
        for (const std::uint32_t pair : {0U, 5U})
        {
            for (const std::uint32_t bits : {1U, 4U, 8U, 10U})
            {
                const std::vector<gpu::uvec2> points = samples(1U << bits, seed, pair);
                for (std::uint32_t along_x = 0; along_x <= bits; ++along_x)
                {
                    std::set<std::uint64_t> intervals;
                    for (const gpu::uvec2& point : points)
                    {
                        const std::uint64_t x = std::uint64_t{point.x} >> (32 - along_x);
                        const std::uint64_t y = std::uint64_t{point.y} >> (32 - (bits - along_x));
                        intervals.insert(x << 32 | y);
                    }
                    EXPECT_EQ(intervals.size(), points.size()) << bits << ' ' << along_x;
                }
            }
        }
    }
}

// Numbers of other pixels and pairs of dimensions are others, and in another order.
TEST(Samples, OfOtherPixelsAreOthers)
{
    const std::vector<gpu::uvec2> points = samples(256, 1, 2);
    std::uint32_t same = 0;
    for (const auto& [seed, pair] : {std::pair(2U, 2U), std::pair(1U, 3U), std::pair(3U, 7U)})
    {
        const std::vector<gpu::uvec2> others = samples(256, seed, pair);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            same += points[i].x >> 24 == others[i].x >> 24 ? 1 : 0;
        }
    }
    EXPECT_LT(same, 20U); // three are expected of 768
}

// The same numbers on every device: these are known.
TEST(Samples, AreKnown)
{
    const std::vector<gpu::uvec2> points = samples(3, 7, 1);
    EXPECT_EQ(points[0], gpu::uvec2(0xC9F9E3BC, 0x14D9AB98));
    EXPECT_EQ(points[1], gpu::uvec2(0x25382CB5, 0xE80A68AE));
    EXPECT_EQ(points[2], gpu::uvec2(0x91BE11A8, 0x93CAA108));
}

} // namespace
} // namespace zvo
