// SPDX-License-Identifier: MIT
#include "vk/hazard_tracker.h"

#include "vk/functions.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>
#include <random>
#include <vector>

namespace
{

using namespace zvo::vk;

constexpr auto kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr auto kIndirect = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
constexpr auto kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr auto kHost = VK_PIPELINE_STAGE_2_HOST_BIT;

Barrier next(HazardTracker& tracker, std::initializer_list<BufferAccess> accesses)
{
    return tracker.next({accesses.begin(), accesses.size()});
}

TEST(HazardTracker, FirstUsesNeedNoBarrier)
{
    HazardTracker tracker;
    EXPECT_FALSE(next(tracker, {{1, Access::KernelRead, ""}, {2, Access::KernelWrite, ""}}).needed());
    EXPECT_FALSE(next(tracker, {{3, Access::CopyWrite, ""}}).needed());
    EXPECT_FALSE(next(tracker, {}).needed());
}

TEST(HazardTracker, ReadAfterReadNeedsNoBarrier)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::KernelRead, ""}});
    EXPECT_FALSE(next(tracker, {{1, Access::KernelRead, ""}}).needed());
    EXPECT_FALSE(next(tracker, {{1, Access::CopyRead, ""}}).needed());
    EXPECT_FALSE(next(tracker, {{1, Access::IndirectRead, ""}}).needed());
}

TEST(HazardTracker, ReadAfterWriteMakesTheWriteVisible)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::KernelWrite, ""}});
    const Barrier barrier = next(tracker, {{1, Access::KernelRead, ""}});
    EXPECT_EQ(barrier.source_stages, kCompute);
    EXPECT_EQ(barrier.source_accesses, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    EXPECT_EQ(barrier.destination_stages, kCompute);
    EXPECT_TRUE(barrier.destination_accesses & VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    EXPECT_FALSE(next(tracker, {{1, Access::KernelRead, ""}}).needed()) << "it is visible already";
}

TEST(HazardTracker, WriteAfterReadWaitsForTheRead)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::CopyRead, ""}});
    const Barrier barrier = next(tracker, {{1, Access::KernelWrite, ""}});
    EXPECT_EQ(barrier.source_stages, kTransfer);
    EXPECT_EQ(barrier.destination_stages, kCompute);
}

TEST(HazardTracker, WriteAfterWriteKeepsTheOrder)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::CopyWrite, ""}});
    const Barrier barrier = next(tracker, {{1, Access::KernelWrite, ""}});
    EXPECT_EQ(barrier.source_stages, kTransfer);
    EXPECT_EQ(barrier.source_accesses, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    EXPECT_EQ(barrier.destination_stages, kCompute);
    EXPECT_TRUE(barrier.destination_accesses & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

TEST(HazardTracker, ReadWriteAfterReadWriteNeedsABarrierEveryTime)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::KernelReadWrite, ""}});
    EXPECT_TRUE(next(tracker, {{1, Access::KernelReadWrite, ""}}).needed());
    EXPECT_TRUE(next(tracker, {{1, Access::KernelReadWrite, ""}}).needed());
}

TEST(HazardTracker, PassesThatAccumulateInABufferNeedNoBarrierBetweenThem)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::CopyWrite, ""}});
    EXPECT_TRUE(next(tracker, {{1, Access::KernelAccumulate, ""}}).needed());
    EXPECT_FALSE(next(tracker, {{1, Access::KernelAccumulate, ""}}).needed());
    EXPECT_TRUE(next(tracker, {{1, Access::KernelRead, ""}}).needed()) << "who reads sees all of them";
    EXPECT_TRUE(next(tracker, {{1, Access::KernelAccumulate, ""}}).needed()) << "and is not overtaken";
    EXPECT_TRUE(next(tracker, {{1, Access::KernelAccumulate, ""}, {1, Access::KernelRead, ""}}).needed())
        << "a pass that also reads the result must wait";
    EXPECT_TRUE(next(tracker, {{1, Access::KernelAccumulate, ""}}).needed());
}

TEST(HazardTracker, IndirectArgumentsWaitForTheKernelThatWritesThem)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::KernelWrite, ""}});
    const Barrier barrier = next(tracker, {{1, Access::IndirectRead, ""}, {2, Access::KernelWrite, ""}});
    EXPECT_EQ(barrier.destination_stages, kIndirect);
    EXPECT_EQ(barrier.destination_accesses, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    EXPECT_EQ(next(tracker, {{1, Access::KernelWrite, ""}}).source_stages, kIndirect)
        << "and are not overwritten early";
}

TEST(HazardTracker, OneBarrierCoversTheOtherBuffersOfItsStages)
{
    HazardTracker tracker;
    next(tracker, {{1, Access::KernelWrite, ""}, {2, Access::KernelWrite, ""}, {3, Access::KernelRead, ""}});
    EXPECT_TRUE(next(tracker, {{1, Access::KernelRead, ""}}).needed());
    EXPECT_FALSE(next(tracker, {{2, Access::KernelReadWrite, ""}}).needed());
    EXPECT_FALSE(next(tracker, {{3, Access::KernelWrite, ""}}).needed());
    EXPECT_TRUE(next(tracker, {{2, Access::CopyRead, ""}}).needed()) << "another stage";
}

TEST(HazardTracker, AccessesOfOnePassDoNotConflictWithEachOther)
{
    HazardTracker tracker;
    EXPECT_FALSE(next(tracker, {{1, Access::KernelRead, ""}, {1, Access::KernelWrite, ""}, {1, Access::KernelRead, ""}})
                     .needed());
}

TEST(HazardTracker, TheHostWaitsForEveryWrite)
{
    HazardTracker tracker;
    EXPECT_FALSE(tracker.releaseToHost().needed());
    next(tracker, {{1, Access::KernelWrite, ""}, {3, Access::KernelRead, ""}});
    next(tracker, {{2, Access::CopyWrite, ""}});
    const Barrier barrier = tracker.releaseToHost();
    EXPECT_EQ(barrier.source_stages, kCompute | kTransfer);
    EXPECT_EQ(barrier.destination_stages, kHost);
    EXPECT_EQ(barrier.destination_accesses, VK_ACCESS_2_HOST_READ_BIT);
    EXPECT_FALSE(tracker.releaseToHost().needed());
    EXPECT_FALSE(next(tracker, {{1, Access::HostRead, ""}}).needed());
    next(tracker, {{1, Access::KernelWrite, ""}});
    EXPECT_TRUE(next(tracker, {{1, Access::HostRead, ""}}).needed());
}

// A brute-force model of the Vulkan specification's memory dependencies ("Synchronization and Cache Control"). It
// checks every pair of conflicting accesses and follows the barriers between them, independently of the tracker.
struct Use
{
    std::uint64_t stage;
    std::uint64_t access;
    bool writes;
};

std::vector<Use> usesOf(Access access)
{
    const Use kernel_read{kCompute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, false};
    const Use texel_read{kCompute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, false};
    const Use kernel_write{kCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, true};
    switch (access)
    {
    case Access::KernelRead:
        return {kernel_read, texel_read};
    case Access::KernelWrite:
        return {kernel_write};
    case Access::KernelReadWrite:
    case Access::KernelAccumulate:
        return {kernel_read, texel_read, kernel_write};
    case Access::IndirectRead:
        return {{kIndirect, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false}};
    case Access::CopyRead:
        return {{kTransfer, VK_ACCESS_2_TRANSFER_READ_BIT, false}};
    case Access::CopyWrite:
        return {{kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT, true}};
    case Access::HostRead:
        return {{kHost, VK_ACCESS_2_HOST_READ_BIT, false}};
    }
    return {};
}

struct Step // a barrier, then a pass
{
    Barrier barrier;
    std::vector<BufferAccess> accesses;
};

bool ordered(const Use& first, const Use& second, std::size_t from, std::size_t to, const std::vector<Step>& steps)
{
    std::uint64_t waiting = 0; // stages that wait for first
    bool available = false;
    bool visible = false;
    for (std::size_t i = from + 1; i <= to; ++i)
    {
        const Barrier& barrier = steps[i].barrier;
        const bool direct = (barrier.source_stages & first.stage) != 0;
        if (!direct && (barrier.source_stages & waiting) == 0)
        {
            continue;
        }
        available |= direct && (barrier.source_accesses & first.access) != 0;
        waiting |= barrier.destination_stages;
        visible |= available && (barrier.destination_stages & second.stage) != 0 &&
                   (barrier.destination_accesses & second.access) != 0;
    }
    return first.writes ? visible : (waiting & second.stage) != 0;
}

bool everyHazardIsCovered(const std::vector<Step>& steps)
{
    for (std::size_t j = 0; j < steps.size(); ++j)
    {
        for (std::size_t i = 0; i < j; ++i)
        {
            for (const BufferAccess& a : steps[i].accesses)
            {
                for (const BufferAccess& b : steps[j].accesses)
                {
                    const bool any_order = a.access == Access::KernelAccumulate && b.access == Access::KernelAccumulate;
                    if (a.resource != b.resource || a.access == Access::HostRead || any_order)
                    {
                        continue;
                    }
                    for (const Use& first : usesOf(a.access))
                    {
                        for (const Use& second : usesOf(b.access))
                        {
                            if ((first.writes || second.writes) && !ordered(first, second, i, j, steps))
                            {
                                return false;
                            }
                        }
                    }
                }
            }
        }
    }
    return true;
}

std::vector<Step> randomSteps(std::mt19937& random)
{
    constexpr Access kAll[] = {Access::KernelRead,       Access::KernelWrite,  Access::KernelReadWrite,
                               Access::KernelAccumulate, Access::IndirectRead, Access::CopyRead,
                               Access::CopyWrite,        Access::HostRead};
    const auto pick = [&](std::uint32_t count) { return static_cast<std::uint32_t>(random() % count); };
    HazardTracker tracker;
    std::vector<Step> steps(2 + pick(20));
    const std::uint32_t buffers = 1 + pick(5);
    for (Step& step : steps)
    {
        for (std::uint32_t count = 1 + pick(4); count > 0; --count)
        {
            step.accesses.push_back({1 + pick(buffers), kAll[pick(std::size(kAll))], ""});
        }
        step.barrier = tracker.next(step.accesses);
    }
    return steps;
}

TEST(HazardTracker, BruteForceModelFindsEveryHazardCovered)
{
    std::mt19937 random(1);
    for (int round = 0; round < 3000; ++round)
    {
        ASSERT_TRUE(everyHazardIsCovered(randomSteps(random))) << "round " << round;
    }
}

TEST(HazardTracker, BruteForceModelNoticesEveryDroppedBarrier)
{
    std::mt19937 random(2);
    int dropped = 0;
    for (int round = 0; round < 1500; ++round)
    {
        std::vector<Step> steps = randomSteps(random);
        for (Step& step : steps)
        {
            if (step.barrier.needed())
            {
                const Barrier kept = std::exchange(step.barrier, {});
                ASSERT_FALSE(everyHazardIsCovered(steps)) << "round " << round << ": a barrier was not needed";
                step.barrier = kept;
                ++dropped;
            }
        }
    }
    EXPECT_GT(dropped, 5000);
}

} // namespace
