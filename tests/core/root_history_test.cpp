// SPDX-License-Identifier: MIT
#include "core/root_history.h"

#include "support/properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

namespace
{

using zvo::HistoryBounds;
using zvo::LayerState;
using zvo::OverlayArena;
using zvo::OverlayRegion;
using zvo::OverlaySpace;
using zvo::RootHistory;
using zvo::RootStep;

constexpr HistoryBounds kUnbounded{.steps_max = SIZE_MAX, .bytes_max = UINT64_MAX};

// Regions of 10 nodes (a byte each) and no voxels.
constexpr OverlaySpace kTenRegions{.static_nodes = 1, .node_capacity = 101, .node_bytes = 1};

std::vector<LayerState> version(std::uint64_t number)
{
    return {{7, number}};
}

bool shows(const RootStep& step, std::uint64_t number)
{
    const std::vector<LayerState> expected = version(number);
    return std::equal(step.layers.begin(), step.layers.end(), expected.begin(), expected.end());
}

class RootHistoryTest : public testing::Test
{
protected:
    // A step of 10 nodes, complete unless told otherwise, whose layers are version(id).
    static std::uint64_t pushPending(RootHistory& history, std::uint32_t nodes = 10)
    {
        const std::optional<OverlayRegion> region = history.allocate(nodes, 0);
        EXPECT_TRUE(region.has_value());
        return history.push(region, version(history.current().id + 1));
    }

    static std::uint64_t push(RootHistory& history, std::uint32_t nodes = 10)
    {
        const std::uint64_t id = pushPending(history, nodes);
        history.complete(id, nodes, 0);
        return id;
    }

    OverlayArena m_arena{kTenRegions};
};

TEST_F(RootHistoryTest, BeginsWithTheStaticOctreeAndNothingElse)
{
    RootHistory history(m_arena, {});
    EXPECT_EQ(history.current().id, 0u);
    EXPECT_EQ(history.current().region, std::nullopt);
    EXPECT_TRUE(history.current().layers.empty());
    EXPECT_FALSE(history.current().pending);
    EXPECT_FALSE(history.undo().has_value());
    EXPECT_FALSE(history.redo().has_value());
    EXPECT_EQ(history.stepBytes(), 0u);
}

TEST_F(RootHistoryTest, UndoAndRedoWalkTheStepsAndTheirLayers)
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

TEST_F(RootHistoryTest, StepsMayShowTheStaticOctree)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    history.push(std::nullopt, {});
    EXPECT_EQ(history.current().region, std::nullopt);
    EXPECT_FALSE(history.current().pending);
    EXPECT_TRUE(shows(*history.undo(), 1));
    EXPECT_TRUE(history.redo()->layers.empty());
    EXPECT_EQ(history.stepBytes(), 10u);
}

TEST_F(RootHistoryTest, RegionsWaitForTheFramesThatMayUseThem)
{
    RootHistory history(m_arena, kUnbounded);
    const std::uint64_t first = history.beginFrame();
    push(history);
    const std::uint64_t second = history.beginFrame();
    history.undo();
    history.push(std::nullopt, {});
    EXPECT_EQ(history.waitingBytes(), 10u);
    const std::uint64_t third = history.beginFrame();
    history.frameDone(first);
    EXPECT_EQ(m_arena.heldBytes(), 10u) << "the second frame began before the region was dropped";
    history.frameDone(second);
    EXPECT_EQ(m_arena.heldBytes(), 0u);
    history.frameDone(third);
    EXPECT_EQ(history.waitingBytes(), 0u);
}

TEST_F(RootHistoryTest, RegionsOfUpdatesThatAreGivenUpWaitToo)
{
    RootHistory history(m_arena, kUnbounded);
    const std::uint64_t frame = history.beginFrame();
    const auto region = history.allocate(10, 0);
    ASSERT_TRUE(region);
    history.giveBack(*region);
    EXPECT_EQ(history.waitingBytes(), 10u);
    history.frameDone(frame);
    EXPECT_EQ(m_arena.heldBytes(), 0u);
}

TEST_F(RootHistoryTest, CompleteUpdatesGiveTheirTailsBackAtOnce)
{
    RootHistory history(m_arena, kUnbounded);
    history.beginFrame();
    const std::uint64_t id = pushPending(history);
    EXPECT_TRUE(history.current().pending);
    history.complete(id, 3, 0);
    EXPECT_FALSE(history.current().pending);
    EXPECT_EQ(history.current().region, (OverlayRegion{1, 3, 0, 0}));
    EXPECT_EQ(m_arena.heldBytes(), 3u);
    EXPECT_EQ(history.stepBytes(), 3u);
}

TEST_F(RootHistoryTest, AFailedUpdateLeavesTheStepBeforeIt)
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

TEST_F(RootHistoryTest, StepsAreNotMovedByFailuresElsewhereInTheLine)
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

TEST_F(RootHistoryTest, TheLastCompleteStepComesBackThoughItFellOff)
{
    RootHistory history(m_arena, {.steps_max = 1});
    push(history);
    const std::uint64_t b = pushPending(history);
    const std::uint64_t c = pushPending(history);
    EXPECT_EQ(history.undoCount(), 1u);
    EXPECT_EQ(history.waitingBytes(), 20u) << "of the first step, and of the second, which may be needed as well";
    history.fail(b);
    EXPECT_EQ(history.waitingBytes(), 10u);
    history.fail(c);
    EXPECT_EQ(history.current().id, 1u) << "two updates failed";
    EXPECT_EQ(history.current().region, (OverlayRegion{1, 10, 0, 0}));
    EXPECT_TRUE(shows(history.current(), 1));
    EXPECT_EQ(history.undoCount(), 1u);
    EXPECT_EQ(history.waitingBytes(), 0u);
}

TEST_F(RootHistoryTest, UpdatesOfDroppedStepsEndLikeOthers)
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

TEST_F(RootHistoryTest, OldestStepsFallOffBeyondTheNumberOfSteps)
{
    RootHistory history(m_arena, {.steps_max = 3});
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

TEST_F(RootHistoryTest, OldestStepsFallOffBeyondTheBytesButNeverTheCurrentOne)
{
    RootHistory history(m_arena, {.steps_max = 100, .bytes_max = 35});
    push(history, 10);
    push(history, 10);
    push(history, 10);
    EXPECT_EQ(history.undoCount(), 3u);
    push(history, 20);
    EXPECT_EQ(history.undoCount(), 2u);
    EXPECT_EQ(history.stepBytes(), 30u);
    push(history, 50);
    EXPECT_EQ(history.undoCount(), 1u);
    EXPECT_EQ(history.stepBytes(), 50u);
    EXPECT_EQ(history.undo()->id, 0u);
    EXPECT_EQ(history.redoCount(), 1u) << "what is undone is kept until something is pushed";
}

TEST_F(RootHistoryTest, WhereMemoryIsShortNoMoreStepsAreDroppedThanItTakes)
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

TEST_F(RootHistoryTest, NoStepIsDroppedInVain)
{
    RootHistory history(m_arena, kUnbounded);
    for (int i = 0; i < 10; ++i)
    {
        push(history);
    }
    EXPECT_EQ(history.allocate(95, 0), std::nullopt) << "the current step keeps ten of a hundred";
    EXPECT_FALSE(history.fitsLater(95, 0));
    EXPECT_EQ(history.undoCount(), 10u);
    const std::uint64_t frame = history.beginFrame();
    EXPECT_EQ(history.allocate(20, 0), std::nullopt);
    EXPECT_EQ(history.undoCount(), 8u);
    EXPECT_EQ(history.allocate(20, 0), std::nullopt);
    EXPECT_EQ(history.undoCount(), 8u) << "the same two suffice, once the frame is done";
    EXPECT_TRUE(history.fitsLater(20, 0));
    history.frameDone(frame);
    EXPECT_EQ(history.allocate(20, 0), (OverlayRegion{1, 20, 0, 0}));
}

TEST_F(RootHistoryTest, ALostFrameLeavesTheLineFromBeforeIt)
{
    RootHistory history(m_arena, {.steps_max = 3});
    push(history);
    push(history);
    push(history);
    const std::uint64_t before = history.beginFrame();
    history.undo();
    const std::uint64_t pending = pushPending(history); // instead of 3
    const std::uint64_t lost = history.beginFrame();
    pushPending(history); // 1 falls off, ...
    pushPending(history); // ... and 2
    history.undo();
    EXPECT_EQ(history.undoCount(), 2u);
    history.frameLost();
    EXPECT_EQ(history.current().id, pending);
    EXPECT_EQ(history.redoCount(), 0u);
    EXPECT_EQ(history.stepBytes(), 30u);
    EXPECT_EQ(history.waitingBytes(), 30u) << "of step 3, and of those that were lost";
    history.frameDone(before);
    history.complete(pending, 10, 0);
    EXPECT_EQ(history.waitingBytes(), 20u) << "the device may have begun with the lost frame";
    history.frameDone(lost);
    EXPECT_EQ(m_arena.heldBytes(), 30u);
    EXPECT_TRUE(shows(*history.undo(), 2));
    EXPECT_TRUE(shows(*history.undo(), 1));
    EXPECT_EQ(push(history), 7u) << "numbers are not used again";
}

TEST_F(RootHistoryTest, UpdatesOfEarlierFramesMayFailBeforeAFrameIsLost)
{
    RootHistory history(m_arena, kUnbounded);
    push(history);
    const std::uint64_t before = history.beginFrame();
    const std::uint64_t failed = pushPending(history);
    const std::uint64_t next = pushPending(history);
    history.beginFrame();
    history.undo();
    pushPending(history);
    history.frameDone(before);
    history.fail(failed);
    history.complete(next, 10, 0);
    history.frameLost();
    EXPECT_EQ(history.current().id, next);
    EXPECT_EQ(history.undo()->id, 1u);
    EXPECT_EQ(history.undoCount(), 1u);
}

TEST_F(RootHistoryTest, GivesEverythingBackAtItsEnd)
{
    {
        RootHistory history(m_arena, kUnbounded);
        history.beginFrame();
        push(history);
        pushPending(history);
        history.undo();
        pushPending(history);
        EXPECT_EQ(m_arena.heldBytes(), 30u);
    }
    EXPECT_EQ(m_arena.heldBytes(), 0u);
    EXPECT_EQ(m_arena.largestFreeNodes(), 100u);
}

TEST_F(RootHistoryTest, AHundredThousandFramesDoNotTakeMoreMemoryThanTheFirstOnes)
{
    // Three frames in flight; a mover whose overlay changes its size; the guess of a size is that of the frame before
    // and half as much again.
    constexpr std::uint32_t kMost = 1000;
    constexpr std::uint32_t kSteps = 16;
    OverlayArena arena({.static_nodes = 1,
                        .node_capacity = 1 + 40 * kMost,
                        .voxel_capacity = 40 * 32 * kMost,
                        .node_bytes = 24,
                        .voxel_block_bytes = 264});
    RootHistory history(arena, {.steps_max = kSteps});
    std::deque<std::pair<std::uint64_t, std::uint64_t>> in_flight; // frame, step
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
            history.frameDone(frame);
            history.complete(id, need(frame), need(frame) * 20);
        }
        const std::uint64_t frame = history.beginFrame();
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
    EXPECT_EQ(history.undoCount(), kSteps);
}

// The device and its user: which memory frames in flight use, what the root slot shows, and what should be in the
// history, all kept without a look at how the history does it.
class Simulation
{
public:
    struct Setup
    {
        std::uint32_t nodes;
        std::uint32_t blocks;
        HistoryBounds bounds;
    };

    explicit Simulation(const Setup& setup)
        : m_bounds(setup.bounds), m_arena({.static_nodes = kStatic,
                                           .node_capacity = kStatic + setup.nodes,
                                           .voxel_capacity = setup.blocks * zvo::kVoxelBlock,
                                           .node_bytes = 3,
                                           .voxel_block_bytes = 5}),
          m_history(m_arena, setup.bounds), m_node_writers(kStatic + setup.nodes), m_block_writers(setup.blocks),
          m_root_slots(kStatic + setup.nodes)
    {
        beginFrame();
    }

    /// An update in the frame that is being recorded. used: of its region, if it succeeds.
    void update(std::uint32_t nodes, std::uint32_t voxels, std::uint32_t used, bool succeeds)
    {
        const std::optional<OverlayRegion> region = allocate(nodes, voxels);
        if (!region)
        {
            return;
        }
        const int writer = ++m_writer_count;
        mark(*region, writer);
        m_owned[writer] = *region;
        m_frames.back().regions.emplace(writer, *region);

        const std::vector<LayerState> layers = {{static_cast<std::uint32_t>(writer), used}};
        Root root{writer, *region, layers};
        root.region.node_capacity = 1 + used % nodes;
        root.region.voxel_capacity = (used % (voxels / zvo::kVoxelBlock + 1)) * zvo::kVoxelBlock;
        if (!succeeds)
        {
            root = m_shown;
        }
        m_root_slots[region->first_node] = root;
        m_shown = root;
        const std::uint64_t id = m_history.push(region, layers);
        m_updates.push_back({id, m_frames.back().number, writer, m_steps[m_current], succeeds, root.region});
        m_truth[id] = root;
        m_told[id] = {writer, layers};
        pushed(id);
    }

    void showStatic()
    {
        const std::uint64_t id = m_history.push(std::nullopt, {});
        m_shown = {};
        m_truth[id] = {};
        m_told[id] = {};
        pushed(id);
    }

    void move(bool back)
    {
        const std::optional<RootStep> step = back ? m_history.undo() : m_history.redo();
        RC_ASSERT(step.has_value() == (back ? m_current > 0 : m_current + 1 < m_steps.size()));
        if (step)
        {
            m_current += back ? std::size_t(-1) : 1;
            m_shown = step->region ? m_root_slots[step->region->first_node] : Root{};
            RC_ASSERT(m_shown == m_truth[m_steps[m_current]]);
            checkCurrent();
        }
    }

    /// An update that is begun and then given up, in this frame.
    void giveUp(std::uint32_t nodes, std::uint32_t voxels)
    {
        if (const std::optional<OverlayRegion> region = allocate(nodes, voxels))
        {
            mark(*region, ++m_writer_count);
            m_frames.back().regions.emplace(m_writer_count, *region);
            m_history.giveBack(*region);
        }
    }

    void nextFrame()
    {
        beginFrame();
        check();
    }

    /// The frame that is being recorded is lost: it did nothing, though its regions may be written.
    void loseFrame()
    {
        const std::uint64_t frame = m_frames.back().number;
        while (!m_updates.empty() && m_updates.back().frame == frame)
        {
            m_updates.pop_back();
        }
        m_history.frameLost();
        m_steps = m_before.steps;
        m_current = m_before.current;
        m_shown = m_truth[m_steps[m_current]];
        nextFrame();
    }

    /// The device is done with the oldest frame but the one being recorded.
    void finishFrame()
    {
        if (m_frames.size() > 1)
        {
            m_frame_done = m_frames.front().number;
            m_history.frameDone(m_frame_done);
            m_frames.pop_front();
        }
    }

    /// The host reads the status of the oldest update whose frame is done.
    void endUpdate()
    {
        if (m_updates.empty() || m_updates.front().frame > m_frame_done)
        {
            return;
        }
        const Update update = m_updates.front();
        m_updates.pop_front();
        if (update.succeeds)
        {
            m_owned[update.writer].node_capacity = update.used.node_capacity;
            m_owned[update.writer].voxel_capacity = update.used.voxel_capacity;
            m_history.complete(update.id, update.used.node_capacity, update.used.voxel_capacity);
        }
        else
        {
            m_history.fail(update.id);
            for (Update& later : m_updates)
            {
                later.before = later.before == update.id ? update.before : later.before;
            }
            removeFailed(m_steps, m_current, update);
            removeFailed(m_before.steps, m_before.current, update);
        }
        RC_ASSERT(m_history.stepBytes() == bytesOfSteps());
    }

    void checkEnd()
    {
        while (m_current > 0)
        {
            move(true);
        }
        while (m_current + 1 < m_steps.size())
        {
            move(false);
        }
        while (!m_updates.empty())
        {
            nextFrame();
            finishFrame();
            endUpdate();
            check();
        }
        while (m_frames.size() > 1)
        {
            finishFrame();
        }
        m_history.frameDone(m_frames.back().number);
        RC_ASSERT(m_history.stepBytes() == bytesOfSteps());
        RC_ASSERT(m_history.waitingBytes() == 0u);
        RC_ASSERT(m_arena.heldBytes() == bytesOfSteps());
    }

    /// What must hold at any time.
    void check()
    {
        RC_ASSERT(m_history.undoCount() == m_current);
        RC_ASSERT(m_history.redoCount() == m_steps.size() - 1 - m_current);
        checkCurrent();
        RC_ASSERT(isIntact(m_shown.writer, m_shown.region));
        for (const Frame& frame : m_frames)
        {
            for (const auto& [writer, region] : frame.regions)
            {
                RC_ASSERT(isIntact(writer, region));
            }
        }
        for (const std::uint64_t id : m_steps)
        {
            RC_ASSERT(isIntact(m_truth[id].writer, m_truth[id].region));
        }
        m_frames.back().regions.emplace(m_shown.writer, m_shown.region); // traced
        checkLayers();
    }

private:
    static constexpr std::uint32_t kStatic = 3;

    // An octree in the device's memory.
    struct Root
    {
        int writer = 0;       // number of the update that made it; 0: the static one
        OverlayRegion region; // what it consists of
        std::vector<LayerState> layers;

        bool operator==(const Root&) const = default;
    };
    struct Told // what the history should say of a step
    {
        int writer = 0;
        std::vector<LayerState> layers;
    };
    struct Update
    {
        std::uint64_t id;
        std::uint64_t frame;
        int writer;
        std::uint64_t before; // step
        bool succeeds;
        OverlayRegion used;
    };
    struct Frame
    {
        std::uint64_t number;
        std::map<int, OverlayRegion> regions; // that it reads or writes, by writer
    };

    void beginFrame()
    {
        m_frames.push_back({m_history.beginFrame(), {}});
        m_before = {m_steps, m_current};
        m_line_changed = false;
    }

    void mark(const OverlayRegion& region, int writer)
    {
        std::fill_n(m_node_writers.begin() + region.first_node, region.node_capacity, writer);
        std::fill_n(m_block_writers.begin() + region.first_voxel / zvo::kVoxelBlock,
                    region.voxel_capacity / zvo::kVoxelBlock, writer);
    }

    // Nobody else has got any of it since.
    [[nodiscard]] bool isIntact(int writer, const OverlayRegion& region) const
    {
        const auto is_writers = [&](int w) { return w == writer; };
        const auto node = m_node_writers.begin() + region.first_node;
        const auto block = m_block_writers.begin() + region.first_voxel / zvo::kVoxelBlock;
        return std::all_of(node, node + region.node_capacity, is_writers) &&
               std::all_of(block, block + region.voxel_capacity / zvo::kVoxelBlock, is_writers);
    }

    [[nodiscard]] std::set<int> writersOfSteps()
    {
        std::set<int> writers;
        for (const std::uint64_t id : m_steps)
        {
            if (const int writer = m_told[id].writer; writer != 0)
            {
                writers.insert(writer);
            }
        }
        return writers;
    }

    // As if it had never been pushed, but for what fell off when it was.
    static void removeFailed(std::vector<std::uint64_t>& steps, std::size_t& current, const Update& update)
    {
        for (std::size_t i = 0; i < steps.size(); ++i)
        {
            if (steps[i] == update.id && steps[i - 1] == update.before)
            {
                steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i));
                current -= current >= i ? 1 : 0;
            }
            else if (steps[i] == update.id)
            {
                steps[i] = update.before;
            }
        }
    }

    [[nodiscard]] std::uint64_t bytesOfSteps()
    {
        std::uint64_t bytes = 0;
        for (const int writer : writersOfSteps())
        {
            bytes += m_arena.bytes(m_owned[writer]);
        }
        return bytes;
    }

    // Whether there would be room beside the regions of the steps alone.
    bool fitsBesideSteps(std::uint32_t nodes, std::uint32_t voxels)
    {
        std::vector<bool> free_nodes(m_node_writers.size(), true);
        std::vector<bool> free_blocks(m_block_writers.size(), true);
        std::fill_n(free_nodes.begin(), kStatic, false);
        for (const int writer : writersOfSteps())
        {
            const OverlayRegion& region = m_owned[writer];
            std::fill_n(free_nodes.begin() + region.first_node, region.node_capacity, false);
            std::fill_n(free_blocks.begin() + region.first_voxel / zvo::kVoxelBlock,
                        region.voxel_capacity / zvo::kVoxelBlock, false);
        }
        const auto has_run = [](const std::vector<bool>& line, std::size_t length)
        { return length == 0 || std::search_n(line.begin(), line.end(), length, true) != line.end(); };
        return has_run(free_nodes, nodes) && has_run(free_blocks, (voxels + 31) / 32);
    }

    bool dropStep()
    {
        if (m_current + 1 < m_steps.size())
        {
            m_steps.pop_back();
            return true;
        }
        if (m_current > 1)
        {
            m_steps.erase(m_steps.begin() + 1);
            --m_current;
            return true;
        }
        return false;
    }

    std::optional<OverlayRegion> allocate(std::uint32_t nodes, std::uint32_t voxels)
    {
        RC_ASSERT(m_history.fitsLater(nodes, voxels) == fitsBesideSteps(nodes, voxels));
        const bool nothing_waits = m_history.waitingBytes() == 0;
        const std::size_t count = m_steps.size();
        const std::optional<OverlayRegion> region = m_history.allocate(nodes, voxels);
        const std::size_t dropped = count - (m_history.undoCount() + m_history.redoCount() + 1);
        for (std::size_t i = 0; i < dropped; ++i)
        {
            RC_ASSERT(!fitsBesideSteps(nodes, voxels)); // this drop was needed
            RC_ASSERT(dropStep());
            m_line_changed = true;
        }
        if (region)
        {
            return region;
        }
        if (fitsBesideSteps(nodes, voxels))
        {
            RC_ASSERT(dropped != 0u || !nothing_waits);
            return region;
        }
        RC_ASSERT(dropped == 0u); // as dropping all would have been in vain:
        const std::vector<std::uint64_t> steps = m_steps;
        const std::size_t current = m_current;
        while (dropStep())
        {
            RC_ASSERT(!fitsBesideSteps(nodes, voxels));
        }
        m_steps = steps;
        m_current = current;
        return region;
    }

    void pushed(std::uint64_t id)
    {
        m_line_changed = true;
        m_steps.resize(m_current + 1);
        m_steps.push_back(id);
        ++m_current;
        while ((m_steps.size() - 1 > m_bounds.steps_max || bytesOfSteps() > m_bounds.bytes_max) && dropStep())
        {
        }
        RC_ASSERT(m_history.stepBytes() == bytesOfSteps());
    }

    void checkCurrent()
    {
        const RootStep step = m_history.current();
        const Told& told = m_told[m_steps[m_current]];
        RC_ASSERT(step.id == m_steps[m_current]);
        RC_ASSERT(std::equal(step.layers.begin(), step.layers.end(), told.layers.begin(), told.layers.end()));
        RC_ASSERT(step.region == (told.writer != 0 ? std::optional(m_owned[told.writer]) : std::nullopt));
        RC_ASSERT(m_shown == m_truth[step.id]);
        RC_ASSERT(step.pending == std::any_of(m_updates.begin(), m_updates.end(),
                                              [&](const Update& update) { return update.id == step.id; }));
        if (!step.pending)
        {
            RC_ASSERT(m_shown.layers == told.layers); // what the device shows is what the host believes
        }
    }

    // None is forgotten that may be shown again, and none is kept for longer.
    void checkLayers()
    {
        std::set<std::uint32_t> expected; // layers here have the numbers of their writers
        for (const std::uint64_t id : m_steps)
        {
            expected.insert(static_cast<std::uint32_t>(m_told[id].writer));
        }
        for (const Update& update : m_updates)
        {
            expected.insert(static_cast<std::uint32_t>(m_told[update.before].writer));
        }
        for (const std::uint64_t id : m_line_changed ? m_before.steps : std::vector<std::uint64_t>{})
        {
            expected.insert(static_cast<std::uint32_t>(m_told[id].writer));
        }
        expected.erase(0);
        std::set<std::uint32_t> seen;
        m_history.forEachLayer([&](const LayerState& state) { seen.insert(state.layer); });
        RC_ASSERT(seen == expected);
    }

    HistoryBounds m_bounds;
    OverlayArena m_arena;
    RootHistory m_history;
    std::vector<int> m_node_writers; // whose each node is, or was
    std::vector<int> m_block_writers;
    std::vector<Root> m_root_slots; // [node]: of regions that start there
    Root m_shown;
    int m_writer_count = 0;
    std::deque<Frame> m_frames; // the last one is being recorded
    std::uint64_t m_frame_done = 0;
    std::deque<Update> m_updates;
    std::vector<std::uint64_t> m_steps{0}; // ids
    std::size_t m_current = 0;
    struct
    {
        std::vector<std::uint64_t> steps;
        std::size_t current = 0;
    } m_before;                            // the line when the frame began
    bool m_line_changed = false;           // since
    std::map<std::uint64_t, Root> m_truth; // of each step, on the device
    std::map<std::uint64_t, Told> m_told;
    std::map<int, OverlayRegion> m_owned; // by writer
};

enum class Act
{
    Update,
    FailingUpdate,
    ShowStatic,
    Undo,
    Redo,
    GiveUp,
    NextFrame,
    LoseFrame,
    FinishFrame,
    EndUpdate
};

std::ostream& operator<<(std::ostream& out, Act act)
{
    static const std::vector<const char*> names{"update",       "failing update", "show static", "undo",
                                                "redo",         "give up",        "next frame",  "lose frame",
                                                "finish frame", "end update"};
    return out << names[static_cast<std::size_t>(act)];
}

TEST(RootHistory, WhatTheDeviceMayUseIsNeverGivenToAnother)
{
    zvo::test::checkProperty(
        1000,
        []
        {
            Simulation::Setup setup{};
            setup.nodes = *rc::gen::inRange(10u, 120u);
            setup.blocks = *rc::gen::inRange(5u, 60u);
            setup.bounds.steps_max = *rc::gen::inRange<std::size_t>(1, 8);
            setup.bounds.bytes_max = *rc::gen::weightedOneOf<std::uint64_t>(
                {{1, rc::gen::just(UINT64_MAX)}, {1, rc::gen::inRange<std::uint64_t>(0, 400)}});
            // (what; nodes, voxels, how much of it is needed)
            const auto operations = *rc::gen::scale(
                4.0,
                rc::gen::container<std::vector<std::tuple<Act, std::uint32_t, std::uint32_t, std::uint32_t>>>(
                    rc::gen::tuple(rc::gen::weightedElement<Act>({{8, Act::Update},
                                                                  {3, Act::FailingUpdate},
                                                                  {1, Act::ShowStatic},
                                                                  {4, Act::Undo},
                                                                  {3, Act::Redo},
                                                                  {1, Act::GiveUp},
                                                                  {8, Act::NextFrame},
                                                                  {3, Act::LoseFrame},
                                                                  {7, Act::FinishFrame},
                                                                  {9, Act::EndUpdate}}),
                                   rc::gen::inRange(1u, 30u), rc::gen::inRange(0u, 300u), rc::gen::inRange(0u, 99u))));
            Simulation simulation(setup);
            for (const auto& [act, nodes, voxels, used] : operations)
            {
                switch (act)
                {
                case Act::Update:
                case Act::FailingUpdate:
                    simulation.update(nodes, voxels, used, act == Act::Update);
                    break;
                case Act::ShowStatic:
                    simulation.showStatic();
                    break;
                case Act::Undo:
                case Act::Redo:
                    simulation.move(act == Act::Undo);
                    break;
                case Act::GiveUp:
                    simulation.giveUp(nodes, voxels);
                    break;
                case Act::NextFrame:
                    simulation.nextFrame();
                    break;
                case Act::LoseFrame:
                    simulation.loseFrame();
                    break;
                case Act::FinishFrame:
                    simulation.finishFrame();
                    break;
                case Act::EndUpdate:
                    simulation.endUpdate();
                    break;
                }
                simulation.check();
            }
            simulation.checkEnd();
        });
}

} // namespace
