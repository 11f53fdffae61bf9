// SPDX-License-Identifier: MIT
#include "vk/kernels.h"

#include <gtest/gtest.h>

namespace
{

using namespace zvo;
using test::device;
using test::iota;

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

TEST(TimerPool, PassesStandWhereTheGraphCountsThem)
{
    vk::BufferOf<gpu::uint> values(device().device(), "values", 64);
    vk::BufferOf<gpu::uint> copies(device().device(), "copies", 64);
    vk::BufferOf<gpu::uint> empty(device().device(), "empty", 0);
    vk::BufferOf<gpu::DispatchArgs> args(device().device(), "args", 1);
    std::vector<std::size_t> counts;
    const std::vector<vk::PassTime> times = device().run(
        [&](vk::FrameGraph& graph)
        {
            const auto count = [&] { counts.push_back(graph.passCount()); };
            count();
            graph.fill(args, 1);
            graph.fill(values, 0);
            count();
            iota(graph, empty);
            graph.fill(values, 0, 0, 0);
            count();
            vk::Pass pass = graph.addPass(gpu::test::Iota{});
            const gpu::FillParams params = {.values = pass.write(values), .count = 64};
            pass.dispatchIndirect(args, 0, params, 1);
            count();
            graph.copy(values, 0, copies, 0, 256);
            count();
        });
    EXPECT_EQ(counts, (std::vector<std::size_t>{0, 2, 2, 3, 4})) << "what does nothing is no pass";
    ASSERT_EQ(times.size(), 4u);
    EXPECT_EQ(times[2].name, "test/iota");
    EXPECT_EQ(times[3].name, "copy values to copies");
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
