// SPDX-License-Identifier: MIT
// A machine that runs strokes of a brush on a DynamicOctree with dynamic objects, and a model of the result.
#pragma once

#include "support/dynamic_scenery.h"
#include "support/edit_model.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

namespace zvo::test
{

struct EditCommand
{
    enum class Action
    {
        Dab,
        EndStroke,
        Undo,
        Redo,
        Add,
        Move,
        Remove,
        Update,
        Slice,   // a slice of an update, under a budget that is far too small
        Submit,  // submits the recorded commands as a frame, without waiting
        Lose,    // records the frame like Submit, but then it fails and is lost
        LoseRun, // the frame is lost after the device has run it
        Compare  // waits for all frames, and updates until all dynamic objects show their last poses
    };

    Action action = Action::Compare;
    Brush brush = {};         // Dab
    std::uint32_t object = 0; // Move, Remove: number of the object among those present
    Item item = {};           // Add; Move takes only its placement and bend
};

/// A dab that fills or paints in blue.
inline EditCommand dab(BrushAction action, const gpu::ivec3& center, std::uint32_t radius,
                       BrushShape shape = BrushShape::Sphere)
{
    constexpr std::uint32_t kBlue = 0xFF0000;
    return {.action = EditCommand::Action::Dab, .brush = {shape, action, center, radius, kBlue}};
}

std::ostream& operator<<(std::ostream& out, const EditCommand& command);

/// Runs commands, and compares what is shown with a model that edits voxel by voxel. Where dynamic objects are, the
/// model merges their voxels, or takes those of a rebuild of the unedited scene. The property fails at any difference.
class EditMachine
{
public:
    static constexpr std::size_t kObjectsMax = 3; // further objects are not added

    /// scenery must be made for the setting. Device and scenery must outlive the machine.
    EditMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, const EditBounds& bounds,
                DynamicScenery& scenery);

    void run(const EditCommand& command);

    /// Compares; then undoes all entries, comparing each, and redoes them, comparing again.
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
    [[nodiscard]] bool recordOne(vk::FrameGraph& graph, const EditCommand& command);
    void move(const EditCommand& command);
    void update(vk::FrameGraph& graph, double budget_ms);
    void submit(Fate fate = Fate::Submit);
    void wait(std::size_t flights_left);
    void compare();
    void compareShown();
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
    std::deque<EditCommand> m_commands;         // of the next frame
    std::deque<std::pair<std::uint64_t, vk::Submission>> m_flights;
};

} // namespace zvo::test
