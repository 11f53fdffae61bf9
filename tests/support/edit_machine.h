// SPDX-License-Identifier: MIT
// A machine that runs strokes of a brush on a DynamicOctree with dynamic objects, and a model of the result.
#pragma once

#include "support/command.h"
#include "support/dynamic_scenery.h"
#include "support/edit_model.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace zvo::test
{

/// Runs commands, and compares what is shown with a model that edits voxel by voxel. Where dynamic objects are, the
/// model merges their voxels, or takes those of a rebuild of the unedited scene. The property fails at any difference.
class EditMachine
{
public:
    static constexpr std::size_t kObjectsMax = 3; // further objects are not added

    /// scenery must be made for the setting. Device and scenery must outlive the machine.
    EditMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, const HistoryBounds& bounds,
                DynamicScenery& scenery);

    void run(const Command& command);

    /// Compares; then undoes all entries, comparing each, and redoes them, comparing again, and a copy of the voxels.
    void finish();

    [[nodiscard]] DynamicOctree& octree() { return *m_octree; }
    [[nodiscard]] const EditModel& model() const { return m_line[m_at]; }

private:
    // The model's state before a frame, which is restored when the frame is lost.
    struct Line
    {
        std::vector<EditModel> line;
        std::size_t at;
    };
    using Objects = std::map<DynamicObjectId, Item>;

    enum class Fate
    {
        Submit,
        Lose,
        LoseRun
    };

    void add(const Item& item);
    bool dab(vk::FrameGraph& graph, const Brush& brush);
    void record(vk::FrameGraph& graph);
    [[nodiscard]] bool recordOne(vk::FrameGraph& graph, const Command& command);
    void move(const Command& command);
    void update(vk::FrameGraph& graph, double budget_ms);
    void submit(Fate fate = Fate::Submit);
    void wait(std::size_t flights_left);
    void compare();
    void compareShown();
    void compareCopy();
    void settle();
    void dropForgotten();

    vk::HeadlessDevice& m_device;
    DynamicSetting m_setting;
    DynamicScenery& m_scenery;
    std::size_t m_entries_max;
    std::unique_ptr<DynamicOctree> m_octree;
    std::vector<EditModel> m_line;
    std::size_t m_at = 0;
    bool m_is_stroke = false;
    Objects m_wanted;                           // last requested states of the objects
    Objects m_under_way;                        // states that the update under way is going to show
    std::optional<Objects> m_shown = Objects(); // after the last frame; nothing if an update failed or a frame was lost
    std::deque<Command> m_commands;             // of the next frame
    std::deque<std::pair<std::uint64_t, vk::Submission>> m_flights;
};

} // namespace zvo::test
