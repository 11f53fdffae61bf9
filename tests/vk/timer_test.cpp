// SPDX-License-Identifier: MIT
#include "vk/kernels.h"

#include <gtest/gtest.h>

namespace
{

using namespace zvo;
using test::device;

void iota(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& values)
{
    vk::Pass pass = graph.addPass("test/iota");
    const gpu::FillParams params = {.values = pass.write(values), .count = static_cast<gpu::uint>(values.count())};
    pass.dispatch(values.count(), params);
}

TEST(TimerPool, TimesHaveTheNamesOfThePassesInOrder)
{
    vk::BufferOf<gpu::uint> values(device().device(), "values", 231917);
    for (int round = 0; round < 2; ++round)
    {
        const std::vector<vk::PassTime> times = device().run(
            [&](vk::FrameGraph& graph)
            {
                graph.fill(values, 0);
                iota(graph, values);
            });
        ASSERT_EQ(times.size(), 2u);
        EXPECT_EQ(times[0].name, "fill values");
        EXPECT_EQ(times[1].name, "test/iota");
        EXPECT_GT(times[1].ms, 0.0);
        EXPECT_LT(times[1].ms, 10'000.0);
    }
}

TEST(TimerPool, PassesPastTheCapacityRunUntimed)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.timer_capacity = 3;
    vk::HeadlessDevice small(options, testKernels());
    vk::BufferOf<gpu::uint> values(small.device(), "values", 64);
    const std::vector<vk::PassTime> times = small.run(
        [&](vk::FrameGraph& graph)
        {
            for (int i = 0; i < 5; ++i)
            {
                iota(graph, values);
            }
        });
    EXPECT_EQ(times.size(), 3u);
    EXPECT_EQ(small.download(values)[63], 63u);
}

TEST(TimerPool, WithoutCapacityNothingIsTimed)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.timer_capacity = 0;
    vk::HeadlessDevice untimed(options, testKernels());
    vk::BufferOf<gpu::uint> values(untimed.device(), "values", 64);
    EXPECT_TRUE(untimed.run([&](vk::FrameGraph& graph) { iota(graph, values); }).empty());
}

} // namespace
