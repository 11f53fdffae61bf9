// SPDX-License-Identifier: MIT
// A machine that runs random commands on a DynamicOctree, with a model of what the octree should show.
#pragma once

#include "support/command.h"
#include "support/dynamic_scenery.h"
#include "support/history_line.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace zvo::test
{

/// Runs commands without strokes, and compares the octree with one that is made anew. Every frame ends with pictures.
/// They have to equal those with which their entry was first seen; when the octrees are compared, also those of the
/// octree made anew. The property fails at any difference.
class DynamicMachine
{
public:
    static constexpr std::size_t kObjectsMax = 4; // further objects are not added

    /// scenery must be made for the setting. Device and scenery must outlive the machine.
    DynamicMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, DynamicScenery& scenery);

    void run(const Command& command);

    /// arm() is called before everything that may fail, and makes something fail until disarm() is called. A frame that
    /// fails is lost.
    void setFailures(std::function<void()> arm, std::function<void()> disarm);

    /// Lost frames, and failed attempts to add a dynamic object.
    [[nodiscard]] std::uint64_t failureCount() const { return m_failure_count; }

    /// Settles, goes back to the first entry, and compares the static part with its first state.
    void finish();

private:
    using Shown = std::map<DynamicObjectId, Item>;
    using Pixels = std::vector<gpu::uint>;

    struct Flight
    {
        std::uint64_t frame;
        std::uint64_t entry; // current when the frame ended
        ShotTaker* taker;
        vk::Submission submission;
    };

    void add(const Item& item);
    bool mayFail(const std::function<void()>& call, bool fails = false);
    void submit(bool loses = false);
    [[nodiscard]] vk::Submission submitFrame(ShotTaker& taker, bool loses);
    void record(vk::FrameGraph& graph, const Command& command);
    void update(vk::FrameGraph& graph, double budget_ms);
    void show(vk::FrameGraph& graph, bool undo);
    void waitForOldest();
    void wait();
    void settle();
    void see(std::uint64_t entry, Pixels pixels);
    void compare();
    [[nodiscard]] ShotTaker& freeTaker();
    [[nodiscard]] Pixels picturesOf(const DeviceTree& tree);
    void applyRule(std::vector<Cell>& expected, std::vector<Cell>& actual, const std::vector<Cell>& fixed,
                   const std::vector<Cell>& moving) const;
    [[nodiscard]] bool isRuled() const { return m_setting.merge != MergeRule::Average && m_setting.attributes; }

    vk::HeadlessDevice& m_device;
    DynamicSetting m_setting;
    DynamicScenery& m_scenery;
    std::uint64_t m_static_emissive = 0;
    std::vector<gpu::uint> m_static;
    std::unique_ptr<DynamicOctree> m_octree;
    std::deque<Flight> m_flights;
    std::vector<Command> m_commands; // of the next frame
    std::uint32_t m_update_count = 0;
    NodePaths m_paths;
    TraceCamera m_camera;
    std::vector<ShotTaker> m_takers;                  // one for each frame in flight
    std::map<std::uint64_t, Pixels> m_pictures;       // by entry, as first seen
    std::map<std::multiset<Item>, Pixels> m_expected; // by objects, of octrees made anew
    Shown m_wanted;                                   // last requested states of the objects
    Shown m_under_way;                                // states that the update under way is going to show
    bool m_is_owed = false;                           // an update was asked for, and its result is not shown
    HistoryLine<Shown> m_line;
    bool m_has_recorded = false; // in the last frame, an update, undo or redo was recorded
    std::function<void()> m_arm;
    std::function<void()> m_disarm;
    std::uint64_t m_failure_count = 0;
};

} // namespace zvo::test
