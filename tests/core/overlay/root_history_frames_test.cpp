// SPDX-License-Identifier: MIT
// The history of roots while frames are in flight.
#include "core/overlay/root_history.h"

#include "root_history_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace zvo::test
{

namespace
{

TEST_F(RootHistoryTest, RegionsWaitForTheFramesThatMayUseThem)
{
    RootHistory history(m_arena, kUnbounded);
    vk::FrameList frames({&history});
    const std::uint64_t first = frames.begin();
    push(history);
    const std::uint64_t second = frames.begin();
    history.undo();
    history.push(std::nullopt, {});
    EXPECT_EQ(history.waitingBytes(), 10u);
    const std::uint64_t third = frames.begin();
    frames.done(first);
    EXPECT_EQ(m_arena.heldBytes(), 10u) << "the second frame began before the region was dropped";
    frames.done(second);
    EXPECT_EQ(m_arena.heldBytes(), 0u);
    frames.done(third);
    EXPECT_EQ(history.waitingBytes(), 0u);
}

TEST_F(RootHistoryTest, RegionsOfUpdatesThatAreGivenUpWaitToo)
{
    RootHistory history(m_arena, kUnbounded);
    vk::FrameList frames({&history});
    const std::uint64_t frame = frames.begin();
    const auto region = history.allocate(10, 0);
    ASSERT_TRUE(region);
    history.giveBack(*region);
    EXPECT_EQ(history.waitingBytes(), 10u);
    frames.done(frame);
    EXPECT_EQ(m_arena.heldBytes(), 0u);
}

TEST_F(RootHistoryTest, ALostFrameLeavesTheLineFromBeforeIt)
{
    RootHistory history(m_arena, {.entries_max = 3});
    vk::FrameList frames({&history});
    push(history);
    push(history);
    push(history);
    const std::uint64_t before = frames.begin();
    history.undo();
    const std::uint64_t pending = pushPending(history); // replaces 3
    const std::uint64_t lost = frames.begin();
    pushPending(history); // drops 1
    pushPending(history); // drops 2
    history.undo();
    EXPECT_EQ(history.undoCount(), 2u);
    frames.lost();
    EXPECT_EQ(history.current().id, pending);
    EXPECT_EQ(history.redoCount(), 0u);
    EXPECT_EQ(history.entryBytes(), 30u);
    EXPECT_EQ(history.waitingBytes(), 30u) << "of entry 3, and of those that were lost";
    frames.done(before);
    history.complete(pending, 10, 0);
    EXPECT_EQ(history.waitingBytes(), 20u) << "the device may have begun with the lost frame";
    frames.done(lost);
    EXPECT_EQ(m_arena.heldBytes(), 30u);
    EXPECT_TRUE(shows(*history.undo(), 2));
    EXPECT_TRUE(shows(*history.undo(), 1));
    EXPECT_EQ(push(history), 7u) << "numbers are not used again";
}

TEST_F(RootHistoryTest, UpdatesOfEarlierFramesMayFailBeforeAFrameIsLost)
{
    RootHistory history(m_arena, kUnbounded);
    vk::FrameList frames({&history});
    push(history);
    const std::uint64_t before = frames.begin();
    const std::uint64_t failed = pushPending(history);
    const std::uint64_t next = pushPending(history);
    frames.begin();
    history.undo();
    pushPending(history);
    frames.done(before);
    history.fail(failed);
    history.complete(next, 10, 0);
    frames.lost();
    EXPECT_EQ(history.current().id, next);
    EXPECT_EQ(history.undo()->id, 1u);
    EXPECT_EQ(history.undoCount(), 1u);
}

TEST_F(RootHistoryTest, AHundredThousandFramesDoNotTakeMoreMemoryThanTheFirstOnes)
{
    // There are three frames in flight. A dynamic object's overlay changes its size, which is guessed as half as much
    // again as in the frame before.
    constexpr std::uint32_t kMost = 1000;
    constexpr std::uint32_t kEntries = 16;
    OverlayArena arena({.static_nodes = 1,
                        .node_capacity = 1 + 40 * kMost,
                        .voxel_capacity = 40 * 32 * kMost,
                        .node_bytes = 24,
                        .voxel_block_bytes = 264});
    RootHistory history(arena, {.entries_max = kEntries});
    vk::FrameList frames({&history});
    std::deque<std::pair<std::uint64_t, std::uint64_t>> in_flight; // frame, entry
    const auto need = [](std::uint64_t frame)
    { return static_cast<std::uint32_t>(kMost / 2 + frame * 7919 % 97 * (kMost / 2) / 96); };
    std::uint32_t end_of_memory = 0;
    std::uint64_t most_held = 0;
    for (std::uint64_t i = 0; i < 100'000; ++i)
    {
        if (in_flight.size() == 3)
        {
            const auto [frame, id] = in_flight.front();
            in_flight.pop_front();
            frames.done(frame);
            history.complete(id, need(frame), need(frame) * 20);
        }
        const std::uint64_t frame = frames.begin();
        const std::uint32_t guess = need(frame - 1) / 2 * 3;
        const auto region = history.allocate(std::max(guess, need(frame)), std::max(guess, need(frame)) * 20);
        ASSERT_TRUE(region) << "frame " << frame;
        in_flight.emplace_back(frame, history.push(region, version(frame)));
        if (i < 1000)
        {
            end_of_memory = std::max(end_of_memory, region->first_node + region->node_capacity);
            most_held = std::max(most_held, arena.heldBytes());
        }
        ASSERT_LE(region->first_node + region->node_capacity, end_of_memory) << "frame " << frame;
        ASSERT_LE(arena.heldBytes(), most_held) << "frame " << frame;
    }
    EXPECT_EQ(history.undoCount(), kEntries);
}

} // namespace

} // namespace zvo::test
