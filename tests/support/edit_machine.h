// SPDX-License-Identifier: MIT
// Strokes of a brush on a DynamicOctree, with dynamic objects above, and a model of what they have to leave.
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
        Slice,   // an update under a budget that is far too small
        Submit,  // what was recorded so far, without waiting
        Lose,    // the same, but it fails when all is recorded
        LoseRun, // the same, and the device has run it
        Compare  // waits for all frames, and updates until dynamic objects are where they were put
    };

    Action action = Action::Compare;
    Brush brush = {};         // Dab
    std::uint32_t object = 0; // Place, Remove: which of those that are there
    Item item = {};           // Add; Place: only the place and the bend
};

/// A dab, blue where it fills or paints.
inline EditCommand dab(BrushAction action, const gpu::ivec3& center, std::uint32_t radius,
                       BrushShape shape = BrushShape::Sphere)
{
    constexpr std::uint32_t kBlue = 0xFF0000;
    return {.action = EditCommand::Action::Dab, .brush = {shape, action, center, radius, kBlue}};
}

std::ostream& operator<<(std::ostream& out, const EditCommand& command);

/// Runs commands, and compares what is shown with a model that edits voxel by voxel, in which a voxel that a dynamic
/// object has looks like the dynamic object, or as rebuilding the unedited scene makes it. Properties fail where they
/// differ.
class EditMachine
{
public:
    static constexpr std::size_t kObjectsMax = 3; // more are not added

    /// scenery: of the setting. Both must outlive the machine.
    EditMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, const EditBounds& bounds,
                DynamicScenery& scenery);

    void run(const EditCommand& command);

    /// Compares, undoes everything that is kept, comparing each entry, and redoes it.
    void finish();

    [[nodiscard]] DynamicOctree& octree() { return *m_octree; }
    [[nodiscard]] const EditModel& model() const { return m_line[m_at]; }

private:
    // What frameLost() brings back.
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
    Objects m_wanted;    // where dynamic objects were put
    Objects m_under_way; // what the update under way is going to show
    std::optional<Objects> m_shown =
        Objects();                      // by the last frame; nothing where an update failed, or a frame was lost
    std::deque<EditCommand> m_commands; // of the frame that is submitted next
    std::deque<std::pair<std::uint64_t, vk::Submission>> m_flights;
};

} // namespace zvo::test
