// SPDX-License-Identifier: MIT
// The line of strokes, without a device.
#include "core/edit/edit_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <set>

namespace zvo
{
namespace
{

TEST(EditHistory, BeginsAtASlotThatNothingWasDoneTo)
{
    EditHistory history(3);
    EXPECT_EQ(history.slot(), 0U);
    EXPECT_EQ(history.undoCount() + history.redoCount(), 0U);
    EXPECT_FALSE(history.undo());
    EXPECT_FALSE(history.redo());
    EXPECT_TRUE(history.isExact());
    EXPECT_EQ(history.top(0).nodes, history.slotCount()) << "the slots' roots come first";
}

TEST(EditHistory, AStrokeIsOneEntryHoweverManyDabsItHas)
{
    EditHistory history(3);
    const std::uint32_t first = history.push(10, 20);
    const std::uint32_t second = history.push(1, 2);
    EXPECT_NE(first, second);
    EXPECT_EQ(history.undoCount(), 1U);
    EXPECT_EQ(history.slot(), second);
    EXPECT_EQ(history.top(second).nodes, history.top(0).nodes + 11);
    EXPECT_EQ(history.top(second).voxels, 22U);
    history.endStroke();
    history.push(0, 0);
    EXPECT_EQ(history.undoCount(), 2U);
    EXPECT_TRUE(history.undo());
    EXPECT_EQ(history.slot(), second);
}

TEST(EditHistory, ADabAfterUndoDropsWhatCouldBeRedone)
{
    EditHistory history(8);
    for (int i = 0; i < 4; ++i)
    {
        history.push(1, 1);
        history.endStroke();
    }
    history.undo();
    history.undo();
    EXPECT_EQ(history.redoCount(), 2U);
    const std::uint64_t nodes = history.top(history.slot()).nodes;
    history.push(5, 5);
    EXPECT_EQ(history.redoCount(), 0U);
    EXPECT_EQ(history.undoCount(), 3U);
    EXPECT_EQ(history.top(history.slot()).nodes, nodes + 5) << "takes the room of what was undone";
}

// The room stays in use as long as the frame of the undo may be lost.
TEST(EditHistory, ADabAfterUndoLeavesRoomToWhatIsKept)
{
    EditHistory history(8);
    history.push(10, 1);
    history.endStroke();
    const std::uint32_t shown = history.push(2, 20);
    const EditTop top = history.top(shown);
    history.undo();
    EXPECT_EQ(history.topAbove(shown).nodes, top.nodes);
    const std::uint32_t slot = history.push(5, 6, shown);
    EXPECT_EQ(history.top(slot).nodes, top.nodes + 5);
    EXPECT_EQ(history.top(slot).voxels, top.voxels + 6);
    history.undo();
    EXPECT_EQ(history.topAbove(history.slot()).nodes, history.top(history.slot()).nodes);
}

TEST(EditHistory, StrokesKeepTheirNumbers)
{
    EditHistory history(4);
    EXPECT_EQ(history.stroke(), 0U);
    EXPECT_EQ(history.nextStroke(), UINT64_MAX);
    for (int stroke = 0; stroke < 3; ++stroke)
    {
        history.push(10, 0);
        history.push(10, 0); // of the same stroke
        history.endStroke();
    }
    EXPECT_EQ(history.stroke(), 3U);
    history.undo();
    history.undo();
    EXPECT_EQ(history.stroke(), 1U);
    EXPECT_EQ(history.nextStroke(), 2U);
    history.push(10, 0);
    EXPECT_EQ(history.stroke(), 4U);
}

TEST(EditHistory, TheOldestEntryFallsOff)
{
    EditHistory history(2);
    for (int i = 0; i < 100; ++i)
    {
        history.push(1, 1);
        history.endStroke();
        EXPECT_LE(history.undoCount(), 2U);
    }
    EXPECT_EQ(std::ranges::count(history.used(), true), 3);
}

// A lost frame may have written the slots that it took, and slots that it freed are in use again.
TEST(EditHistory, SlotsThatAFrameFreesAreNotUsedAgainInIt)
{
    EditHistory history(2);
    for (int frame = 0; frame < 50; ++frame)
    {
        std::vector<bool> used = history.used();
        if (frame % 3 == 0)
        {
            history.undo();
        }
        for (std::uint32_t i = 0; i < kDabsPerFrameMax; ++i)
        {
            const std::uint32_t slot = history.push(1, 1);
            EXPECT_FALSE(used[slot]) << frame << ' ' << i;
            if (i % 3 == 0)
            {
                history.endStroke();
            }
        }
    }
}

TEST(EditHistory, DropsTheOlderHalf)
{
    EditHistory history(8);
    for (int i = 0; i < 7; ++i)
    {
        history.push(1, 1);
        history.endStroke();
    }
    const std::uint32_t shown = history.slot();
    for (const std::size_t left : {3U, 1U, 0U})
    {
        EXPECT_TRUE(history.dropOldest());
        EXPECT_EQ(history.undoCount(), left);
        EXPECT_EQ(history.slot(), shown);
    }
    EXPECT_FALSE(history.dropOldest());
}

TEST(EditHistory, DropsStrokesThatHaveChangedNothing)
{
    EditHistory history(10);
    const std::uint64_t first = history.slotCount();
    history.learn(0, {first, 0, 100, true});
    const std::uint32_t carved = history.push(50, 64);
    history.endStroke();
    history.learn(carved, {first + 10, 64, 90, true});
    EXPECT_EQ(history.dropUnchanged(), 0U);
    const std::uint32_t idle = history.push(50, 64);
    history.endStroke();
    EXPECT_EQ(history.dropUnchanged(), 0U) << "nothing is known yet";
    history.learn(idle, {first + 10, 96, 90, true}); // voxels' tops are rounded up
    EXPECT_EQ(history.dropUnchanged(), 1U);
    EXPECT_EQ(history.undoCount(), 1U);
    EXPECT_EQ(history.slot(), carved);

    const std::uint32_t begun = history.push(50, 64);
    history.learn(begun, {first + 10, 96, 90, true});
    EXPECT_EQ(history.dropUnchanged(), 0U) << "the stroke is under way";
    const std::uint32_t painted = history.push(50, 64);
    history.endStroke();
    history.learn(painted, {first + 20, 128, 90, true});
    EXPECT_EQ(history.dropUnchanged(), 0U) << "its last dab has changed something";
    const std::uint32_t changes = history.push(50, 64);
    history.learn(changes, {first + 30, 128, 90, true});
    const std::uint32_t ends = history.push(50, 64);
    history.endStroke();
    history.learn(ends, {first + 30, 160, 90, true});
    EXPECT_EQ(history.dropUnchanged(), 0U) << "its first dab has";

    const std::uint32_t redone = history.push(50, 64);
    history.learn(redone, {first + 30, 160, 90, true});
    history.undo();
    EXPECT_EQ(history.redoCount(), 1U);
    EXPECT_EQ(history.dropUnchanged(), 1U);
    EXPECT_EQ(history.redoCount(), 0U);
    EXPECT_EQ(history.slot(), ends);

    const std::uint32_t moved = history.push(50, 64);
    history.endStroke();
    history.forgetTops(); // what was there before the stroke stands elsewhere
    history.learn(moved, {first + 30, 160, 90, true});
    EXPECT_EQ(history.dropUnchanged(), 0U);
}

TEST(EditHistory, KnowsWhetherTheDeviceHasToldAllTops)
{
    EditHistory history(8);
    const std::uint32_t slot = history.push(100, 100);
    EXPECT_FALSE(history.isExact());
    history.learn(slot, {history.slotCount() + 3ULL, 4, 5, true});
    EXPECT_TRUE(history.isExact());
    EXPECT_EQ(history.top(slot).voxels, 4U);
    history.forgetTops();
    EXPECT_FALSE(history.isExact());
}

} // namespace
} // namespace zvo
