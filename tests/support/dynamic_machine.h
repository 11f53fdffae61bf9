// SPDX-License-Identifier: MIT
// Commands to a DynamicOctree, and a model of what it has to show.
#pragma once

#include "support/mover_scenery.h"
#include "support/step_line.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <ostream>
#include <vector>

namespace zvo::test
{

struct Command
{
    enum class Action
    {
        Add,
        Place,
        Remove,
        Update,
        Slice, // an update under a budget that is far too small
        Undo,
        Redo,
        Submit, // what was recorded so far, without waiting
        Wait,   // for all frames; what is shown is compared
        Settle  // updates until everything is shown, and compares
    };

    Action action = Action::Settle;
    std::uint32_t mover = 0; // Place, Remove: which of those that are there
    Item item;               // Add; Place: only the place
};

std::ostream& operator<<(std::ostream& out, const Command& command);

/// Runs commands, and compares the octree with one that is made anew. Properties fail where they differ.
class DynamicMachine
{
public:
    static constexpr std::size_t kMoversMax = 4; // more are not added

    /// scenery: of the setting. Both must outlive the machine.
    DynamicMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, MoverScenery& scenery);

    void run(const Command& command);

    /// Settles, and compares the static octree with what it was.
    void finish();

private:
    using Shown = std::map<MoverId, Item>;

    struct Flight
    {
        std::uint64_t frame;
        vk::Submission submission;
    };

    void add(const Item& item);
    void submit();
    void record(vk::FrameGraph& graph, const Command& command);
    void update(vk::FrameGraph& graph, double budget_ms);
    void show(vk::FrameGraph& graph, bool undo);
    void waitForOldest();
    void wait();
    void settle();
    void compare();
    void applyRule(std::vector<Cell>& expected, std::vector<Cell>& actual, const std::vector<Cell>& fixed,
                   const std::vector<Cell>& moving) const;
    [[nodiscard]] std::vector<gpu::uint> staticBytes(const Octree& octree) const;

    vk::HeadlessDevice& m_device;
    DynamicSetting m_setting;
    MoverScenery& m_scenery;
    std::uint64_t m_static_emissive = 0;
    std::vector<gpu::uint> m_static;
    std::unique_ptr<DynamicOctree> m_octree;
    std::deque<Flight> m_flights;
    std::vector<Command> m_commands; // of the frame that is submitted next
    std::uint32_t m_update_count = 0;
    Shown m_wanted;         // where movers were put
    Shown m_under_way;      // what the update under way is going to show
    bool m_is_owed = false; // an update was asked for, and is not shown
    StepLine<Shown> m_line;
};

} // namespace zvo::test
