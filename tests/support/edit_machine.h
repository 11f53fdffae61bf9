// SPDX-License-Identifier: MIT
// Strokes of a brush on a DynamicOctree, and a model of what they have to leave.
#pragma once

#include "support/edit_model.h"
#include "support/mover_scenery.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
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
        Submit, // what was recorded so far, without waiting
        Lose,   // the same, but it fails when all is recorded
        Compare // waits for all frames
    };

    Action action = Action::Compare;
    Brush brush;
};

std::ostream& operator<<(std::ostream& out, const EditCommand& command);

/// Runs commands, and compares what is shown with a model that edits voxel by voxel. Properties fail where they differ.
class EditMachine
{
public:
    /// scenery: of the setting. Both must outlive the machine.
    EditMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, const EditBounds& bounds,
                MoverScenery& scenery);

    void run(const EditCommand& command);

    /// Compares, undoes everything that is kept, comparing each step, and redoes it.
    void finish();

    [[nodiscard]] DynamicOctree& octree() { return *m_octree; }
    [[nodiscard]] const EditModel& model() const { return m_line[m_at]; }
    [[nodiscard]] std::uint32_t failureCount() const { return m_failure_count; }

private:
    // What frameLost() brings back.
    struct Line
    {
        std::vector<EditModel> line;
        std::size_t at;
    };

    bool dab(vk::FrameGraph& graph, const Brush& brush);
    void record(vk::FrameGraph& graph);
    void submit(bool loses);
    void wait(std::size_t flights_left);
    void compare();
    void dropForgotten();

    vk::HeadlessDevice& m_device;
    DynamicSetting m_setting;
    std::size_t m_steps_max;
    std::unique_ptr<DynamicOctree> m_octree;
    std::vector<EditModel> m_line;
    std::size_t m_at = 0;
    bool m_is_stroke = false;
    std::deque<EditCommand> m_commands; // of the frame that is submitted next
    std::deque<std::pair<std::uint64_t, vk::Submission>> m_flights;
    std::uint32_t m_failure_count = 0;
};

} // namespace zvo::test
