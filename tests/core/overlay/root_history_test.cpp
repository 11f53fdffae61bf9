// SPDX-License-Identifier: MIT
#include "core/overlay/root_history.h"

#include "root_history_fixture.h"

#include <gtest/gtest.h>

#include <optional>

namespace zvo::test
{

namespace
{

TEST_F(RootHistoryTest, BeginsWithTheStaticOctreeAndNothingElse)
{
    RootHistory history(m_arena, {64, UINT64_MAX});
    EXPECT_EQ(history.current().id, 0u);
    EXPECT_EQ(history.current().region, std::nullopt);
    EXPECT_TRUE(history.current().layers.empty());
    EXPECT_FALSE(history.current().pending);
    EXPECT_FALSE(history.undo().has_value());
    EXPECT_FALSE(history.redo().has_value());
    EXPECT_EQ(history.entryBytes(), 0u);
}

TEST_F(RootHistoryTest, UndoAndRedoWalkTheEntriesAndTheirLayers)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    push(history);
    push(history);
    EXPECT_TRUE(shows(*history.undo(), 2));
    EXPECT_TRUE(shows(*history.undo(), 1));
    EXPECT_EQ(history.undo()->region, std::nullopt) << "the static octree";
    EXPECT_FALSE(history.undo().has_value());
    EXPECT_EQ(history.redoCount(), 3u);
    EXPECT_EQ(history.redo()->region, (OverlayRegion{1, 10, 0, 0}));
    EXPECT_EQ(history.redo()->region, (OverlayRegion{11, 10, 0, 0}));
    EXPECT_TRUE(shows(*history.redo(), 3));
    EXPECT_FALSE(history.redo().has_value());
    EXPECT_EQ(history.undoCount(), 3u);
}

TEST_F(RootHistoryTest, PushDropsWhatWasUndone)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    push(history);
    push(history);
    history.undo();
    history.undo();
    const std::uint64_t id = push(history);
    EXPECT_EQ(id, 4u) << "numbers are not used again";
    EXPECT_EQ(history.current().id, id);
    EXPECT_EQ(history.redoCount(), 0u);
    EXPECT_EQ(history.undoCount(), 2u);
    EXPECT_EQ(m_arena.heldBytes(), 20u);
}

TEST_F(RootHistoryTest, EntriesMayShowTheStaticOctree)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    history.push(std::nullopt, {});
    EXPECT_EQ(history.current().region, std::nullopt);
    EXPECT_FALSE(history.current().pending);
    EXPECT_TRUE(shows(*history.undo(), 1));
    EXPECT_TRUE(history.redo()->layers.empty());
    EXPECT_EQ(history.entryBytes(), 10u);
}

TEST_F(RootHistoryTest, CompleteUpdatesGiveTheirTailsBackAtOnce)
{
    RootHistory history(m_arena, kUnbounded);
    vk::FrameList frames({&history});
    frames.begin();
    const std::uint64_t id = pushPending(history);
    EXPECT_TRUE(history.current().pending);
    history.complete(id, 3, 0);
    EXPECT_FALSE(history.current().pending);
    EXPECT_EQ(history.current().region, (OverlayRegion{1, 3, 0, 0}));
    EXPECT_EQ(m_arena.heldBytes(), 3u);
    EXPECT_EQ(history.entryBytes(), 3u);
}

TEST_F(RootHistoryTest, AFailedUpdateLeavesTheEntryBeforeIt)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    const std::uint64_t failed = pushPending(history);
    EXPECT_EQ(history.current().id, failed);
    history.fail(failed);
    EXPECT_EQ(history.current().id, 1u);
    EXPECT_EQ(history.current().region, (OverlayRegion{1, 10, 0, 0}));
    EXPECT_TRUE(shows(history.current(), 1));
    EXPECT_EQ(history.undoCount(), 1u);
    EXPECT_EQ(m_arena.heldBytes(), 10u);
    EXPECT_EQ(push(history), 3u);
    EXPECT_EQ(history.undo()->id, 1u);
}

TEST_F(RootHistoryTest, EntriesAreNotMovedByFailuresElsewhereInTheLine)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    const std::uint64_t b = pushPending(history);
    const std::uint64_t c = pushPending(history);
    pushPending(history);
    history.undo();
    history.fail(b);
    EXPECT_EQ(history.current().id, c);
    EXPECT_TRUE(history.current().pending);
    EXPECT_EQ(history.undoCount(), 2u);
    EXPECT_EQ(history.redoCount(), 1u);
    EXPECT_EQ(history.undo()->id, 1u) << "what c followed, now that b is gone";
    history.fail(c);
    EXPECT_EQ(history.current().id, 1u);
    EXPECT_EQ(history.redo()->id, 4u);
}

TEST_F(RootHistoryTest, FailuresInARowFallBackToTheLastThatSucceeded)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    const std::uint64_t a = pushPending(history);
    const std::uint64_t b = pushPending(history);
    const std::uint64_t c = pushPending(history);
    history.fail(a);
    history.fail(b);
    history.fail(c);
    EXPECT_TRUE(shows(history.current(), 1));
    EXPECT_EQ(m_arena.heldBytes(), 10u);
}

TEST_F(RootHistoryTest, AFirstUpdateThatFailsShowsTheStaticOctree)
{
    RootHistory history(m_arena, kUnbounded);
    history.fail(pushPending(history));
    EXPECT_EQ(history.current().region, std::nullopt);
    EXPECT_TRUE(history.current().layers.empty());
    EXPECT_EQ(m_arena.heldBytes(), 0u);
}

TEST_F(RootHistoryTest, TheLastCompleteEntryComesBackThoughItFellOff)
{
    RootHistory history(m_arena, {.entries_max = 1});
    push(history);
    const std::uint64_t b = pushPending(history);
    const std::uint64_t c = pushPending(history);
    EXPECT_EQ(history.undoCount(), 1u);
    EXPECT_EQ(history.waitingBytes(), 20u) << "of the first entry, and of the second, which may be needed as well";
    history.fail(b);
    EXPECT_EQ(history.waitingBytes(), 10u);
    history.fail(c);
    EXPECT_EQ(history.current().id, 1u) << "two updates failed";
    EXPECT_EQ(history.current().region, (OverlayRegion{1, 10, 0, 0}));
    EXPECT_TRUE(shows(history.current(), 1));
    EXPECT_EQ(history.undoCount(), 1u);
    EXPECT_EQ(history.waitingBytes(), 0u);
}

TEST_F(RootHistoryTest, UpdatesOfDroppedEntriesEndLikeOthers)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    const std::uint64_t dropped = pushPending(history);
    history.undo();
    const std::uint64_t next = pushPending(history);
    EXPECT_EQ(m_arena.heldBytes(), 30u) << "the device still writes the dropped one";
    history.fail(dropped);
    EXPECT_EQ(m_arena.heldBytes(), 20u);
    history.fail(next);
    EXPECT_TRUE(shows(history.current(), 1));
}

TEST_F(RootHistoryTest, OldestEntriesFallOffBeyondTheNumberOfEntries)
{
    RootHistory history(m_arena, {.entries_max = 3});
    for (int i = 0; i < 5; ++i)
    {
        push(history);
    }
    EXPECT_EQ(history.undoCount(), 3u);
    EXPECT_EQ(m_arena.heldBytes(), 30u);
    history.undo();
    EXPECT_EQ(history.undo()->id, 3u);
    EXPECT_EQ(history.undo()->id, 0u) << "the static octree never falls off";
}

TEST_F(RootHistoryTest, OldestEntriesFallOffBeyondTheBytesButNeverTheCurrentOne)
{
    RootHistory history(m_arena, {.entries_max = 100, .bytes_max = 35});
    push(history, 10);
    push(history, 10);
    push(history, 10);
    EXPECT_EQ(history.undoCount(), 3u);
    push(history, 20);
    EXPECT_EQ(history.undoCount(), 2u);
    EXPECT_EQ(history.entryBytes(), 30u);
    push(history, 50);
    EXPECT_EQ(history.undoCount(), 1u);
    EXPECT_EQ(history.entryBytes(), 50u);
    EXPECT_EQ(history.undo()->id, 0u);
    EXPECT_EQ(history.redoCount(), 1u) << "what is undone is kept until something is pushed";
}

TEST_F(RootHistoryTest, WhereMemoryIsShortNoMoreEntriesAreDroppedThanItTakes)
{
    RootHistory history(m_arena, kUnbounded);
    for (int i = 0; i < 10; ++i)
    {
        push(history);
    }
    history.undo();
    EXPECT_TRUE(history.allocate(10, 0).has_value());
    EXPECT_EQ(history.redoCount(), 0u) << "what was undone goes first";
    EXPECT_EQ(history.undoCount(), 9u);
    EXPECT_EQ(history.allocate(25, 0), (OverlayRegion{1, 25, 0, 0}));
    EXPECT_EQ(history.undoCount(), 6u);
}

TEST_F(RootHistoryTest, NoEntryIsDroppedInVain)
{
    RootHistory history(m_arena, kUnbounded);
    vk::FrameList frames({&history});
    for (int i = 0; i < 10; ++i)
    {
        push(history);
    }
    EXPECT_EQ(history.allocate(95, 0), std::nullopt) << "the current entry keeps ten of a hundred";
    EXPECT_FALSE(history.fitsLater(95, 0));
    EXPECT_EQ(history.undoCount(), 10u);
    const std::uint64_t frame = frames.begin();
    EXPECT_EQ(history.allocate(20, 0), std::nullopt);
    EXPECT_EQ(history.undoCount(), 8u);
    EXPECT_EQ(history.allocate(20, 0), std::nullopt);
    EXPECT_EQ(history.undoCount(), 8u) << "the same two suffice, once the frame is done";
    EXPECT_TRUE(history.fitsLater(20, 0));
    frames.done(frame);
    EXPECT_EQ(history.allocate(20, 0), (OverlayRegion{1, 20, 0, 0}));
}

TEST_F(RootHistoryTest, GivesEverythingBackAtItsEnd)
{
    {
        RootHistory history(m_arena, kUnbounded);
        vk::FrameList frames({&history});
        frames.begin();
        push(history);
        pushPending(history);
        history.undo();
        pushPending(history);
        EXPECT_EQ(m_arena.heldBytes(), 30u);
    }
    EXPECT_EQ(m_arena.heldBytes(), 0u);
    EXPECT_EQ(m_arena.largestFreeNodes(), 100u);
}

} // namespace

} // namespace zvo::test
