// SPDX-License-Identifier: MIT
// Commands to a DynamicOctree, and a model of what it has to show.
#pragma once

#include "support/dynamic_scenery.h"
#include "support/history_line.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <vector>

namespace zvo::test
{

struct Command
{
    enum class Action
    {
        Add,
        Move,
        Bend,
        Remove,
        Update,
        Slice, // an update under a budget that is far too small
        Undo,
        Redo,
        Submit, // what was recorded so far, without waiting
        Lose,   // the same, but it fails when all is recorded
        Wait,   // for all frames; what is shown is compared
        Settle  // updates until everything is shown, and compares
    };

    Action action = Action::Settle;
    std::uint32_t object = 0; // Place, Bend, Remove: which of those that are there
    Item item;                // Add; Place: only the place and the bend; Bend: only the bend
};

std::ostream& operator<<(std::ostream& out, const Command& command);

/// Runs commands, and compares the octree with one that is made anew. Every frame ends with a picture: it has to be the
/// one that its entry was first seen in and, where the octrees are compared, the one of the octree made anew.
/// Properties fail where anything differs.
class DynamicMachine
{
public:
    static constexpr std::size_t kObjectsMax = 4; // more are not added

    /// scenery: of the setting. Both must outlive the machine.
    DynamicMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, DynamicScenery& scenery);

    void run(const Command& command);

    /// arm makes something fail until disarm is called: around whatever may fail. Frames that fail are lost.
    void setFailures(std::function<void()> arm, std::function<void()> disarm);

    /// Frames that were lost, and dynamic objects that were added only when nothing failed.
    [[nodiscard]] std::uint64_t failureCount() const { return m_failure_count; }

    /// Settles, goes back to the first entry, and compares the static tree with what it was.
    void finish();

private:
    using Shown = std::map<DynamicObjectId, Item>;
    using Pixels = std::vector<gpu::uint>;

    struct Flight
    {
        std::uint64_t frame;
        std::uint64_t entry; // that is shown in the end
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
    [[nodiscard]] std::vector<gpu::uint> staticBytes(const DeviceTree& tree, std::uint64_t node_end) const;

    vk::HeadlessDevice& m_device;
    DynamicSetting m_setting;
    DynamicScenery& m_scenery;
    std::uint64_t m_static_emissive = 0;
    std::vector<gpu::uint> m_static;
    std::unique_ptr<DynamicOctree> m_octree;
    std::deque<Flight> m_flights;
    std::vector<Command> m_commands; // of the frame that is submitted next
    std::uint32_t m_update_count = 0;
    BeamGrid m_beam;
    TraceCamera m_camera;
    std::vector<ShotTaker> m_takers;                  // one for each frame in flight
    std::map<std::uint64_t, Pixels> m_pictures;       // of entries that were seen
    std::map<std::multiset<Item>, Pixels> m_expected; // pictures of what was made anew
    Shown m_wanted;                                   // where dynamic objects were put
    Shown m_under_way;                                // what the update under way is going to show
    bool m_is_owed = false;                           // an update was asked for, and is not shown
    HistoryLine<Shown> m_line;
    bool m_has_recorded = false; // in the last frame
    std::function<void()> m_arm;
    std::function<void()> m_disarm;
    std::uint64_t m_failure_count = 0;
};

} // namespace zvo::test
