// SPDX-License-Identifier: MIT
// Deliberate faults. A script that runs tests under a tool first runs a fault that the tool should find. Silence about
// the tests counts only if the tool has reported the fault.
#include "vk/kernels.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace zvo
{
namespace
{

constexpr std::uint32_t kCount = 1U << 18; // so many that all threads of the device take part

// For scripts/check-valgrind.
TEST(Control, DISABLED_WorkgroupsRaceForAWord)
{
    vk::BufferOf<gpu::uint> values(test::device().device(), "values", kCount);
    test::device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::Pass pass = graph.addPass(gpu::test::Race{});
            const gpu::FillParams params{.values = pass.write(values), .count = kCount};
            pass.dispatch(kCount, params);
        });
    EXPECT_LT(test::device().download(values, 0, 1).front(), kCount);
}

// For scripts/check-valgrind.
TEST(Control, DISABLED_KernelBranchesOnFreshMemory)
{
    const vk::BufferOf<gpu::uint> fresh(test::device().device(), "fresh", kCount);
    vk::BufferOf<gpu::uint> steps(test::device().device(), "steps", kCount);
    test::device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::Pass pass = graph.addPass(gpu::test::Branch{});
            const gpu::CopyParams params{
                .source = pass.read(fresh), .destination = pass.write(steps), .count = kCount, .factor = 1};
            pass.dispatch(kCount, params);
        });
    EXPECT_LE(test::device().download(steps, 0, 1).front(), 15U);
}

// For scripts/check-sanitizers. The volatile variables hide the fault from the compiler.
TEST(Control, DISABLED_HostReadsFreedMemory)
{
    auto value = std::make_unique<int>(7);
    const int* volatile freed = value.get();
    value.reset();
    EXPECT_EQ(*freed, 7);
}

// For scripts/check-sanitizers.
TEST(Control, DISABLED_HostAddsPastTheLargestNumber)
{
    const volatile int largest = std::numeric_limits<int>::max();
    EXPECT_LT(largest + 1, largest);
}

// For scripts/check-poison.
TEST(Control, DISABLED_FreshMemoryIsNotZero)
{
    const vk::BufferOf<gpu::uint> fresh(test::device().device(), "fresh", kCount);
    EXPECT_NE(test::device().download(fresh), std::vector<gpu::uint>(kCount, 0U));
}

} // namespace
} // namespace zvo
