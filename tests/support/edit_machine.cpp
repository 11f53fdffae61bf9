// SPDX-License-Identifier: MIT
#include "support/edit_machine.h"

#include "zvo/error.h"

#include <rapidcheck.h>

#include <array>
#include <string>
#include <utility>

namespace zvo::test
{

namespace
{

constexpr int kAttemptsMax = 64;
constexpr std::array kActionNames = {"dab", "end of stroke", "undo", "redo", "submit", "lose", "compare"};
constexpr std::array kBrushNames = {"carve", "fill", "paint"};

} // namespace

std::ostream& operator<<(std::ostream& out, const EditCommand& command)
{
    out << kActionNames.at(static_cast<std::size_t>(command.action));
    if (command.action == EditCommand::Action::Dab)
    {
        const Brush& brush = command.brush;
        out << ' ' << kBrushNames.at(static_cast<std::size_t>(brush.action))
            << (brush.shape == BrushShape::Box ? " box " : " sphere ") << brush.radius << " at " << brush.center.x
            << ' ' << brush.center.y << ' ' << brush.center.z;
    }
    return out;
}

EditMachine::EditMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, const EditBounds& bounds,
                         MoverScenery& scenery)
    : m_device(device), m_setting(setting), m_steps_max(bounds.steps_max)
{
    DynamicOptions options = setting.options(scenery.emissionScale());
    options.edits = bounds;
    m_octree = std::make_unique<DynamicOctree>(device, scenery.buildStatic(setting), options);
    m_line.emplace_back(setting.grid(), cellsOf(device, m_octree->tree()), setting.attributes);
}

void EditMachine::run(const EditCommand& command)
{
    switch (command.action)
    {
    case EditCommand::Action::Submit:
    case EditCommand::Action::Lose:
        submit(command.action == EditCommand::Action::Lose);
        break;
    case EditCommand::Action::Compare:
        compare();
        break;
    default:
        m_commands.push_back(command);
        if (m_commands.size() == kDabsPerFrameMax)
        {
            submit(false);
        }
    }
}

// Whether the octree took it.
bool EditMachine::dab(vk::FrameGraph& graph, const Brush& brush)
{
    const std::uint64_t before = m_octree->edits().changeCount();
    const bool is_done = m_octree->edit(graph, brush);
    dropForgotten();
    if (!is_done || m_octree->edits().changeCount() == before) // nothing of the grid is under the brush
    {
        return is_done;
    }
    EditModel edited = m_line[m_at];
    edited.apply(brush);
    m_line.resize(m_at + 1, edited);
    if (m_is_stroke)
    {
        m_line.back() = std::move(edited);
    }
    else
    {
        m_line.push_back(std::move(edited));
    }
    if (m_line.size() - 1 > m_steps_max)
    {
        m_line.erase(m_line.begin());
    }
    m_at = m_line.size() - 1;
    m_is_stroke = true;
    return true;
}

// Steps that were dropped to make room.
void EditMachine::dropForgotten()
{
    const Edits& edits = m_octree->edits();
    while (m_at > edits.undoCount())
    {
        m_line.erase(m_line.begin());
        --m_at;
    }
    while (m_line.size() - 1 - m_at > edits.redoCount())
    {
        m_line.pop_back();
    }
}

void EditMachine::record(vk::FrameGraph& graph)
{
    for (; !m_commands.empty(); m_commands.pop_front())
    {
        const EditCommand& command = m_commands.front();
        switch (command.action)
        {
        case EditCommand::Action::Dab:
            if (!dab(graph, command.brush))
            {
                return; // in a later frame
            }
            break;
        case EditCommand::Action::EndStroke:
            m_octree->endStroke();
            m_is_stroke = false;
            break;
        default:
            const bool undo = command.action == EditCommand::Action::Undo;
            const bool moves = undo ? m_at != 0 : m_at + 1 != m_line.size();
            RC_ASSERT((undo ? m_octree->undoEdit(graph) : m_octree->redoEdit(graph)) == moves);
            m_at += moves ? (undo ? -1 : 1) : 0;
            m_is_stroke = false;
        }
    }
}

void EditMachine::submit(bool loses)
{
    if (m_commands.empty())
    {
        return;
    }
    wait(m_setting.frames_in_flight - 1);
    const std::uint64_t frame = m_octree->beginFrame();
    const Line before = {m_line, m_at};
    try
    {
        vk::Submission submission = m_device.submit(
            [&](vk::FrameGraph& graph)
            {
                record(graph);
                if (loses)
                {
                    throw Error(ErrorCode::Other, "the frame is lost");
                }
            });
        m_flights.emplace_back(frame, std::move(submission));
    }
    catch (const Error&)
    {
        ++m_failure_count;
        m_commands.clear();
        m_octree->frameLost();
        m_line = before.line;
        m_at = before.at;
        m_is_stroke = false;
        dropForgotten();
    }
}

void EditMachine::wait(std::size_t flights_left)
{
    for (; m_flights.size() > flights_left; m_flights.pop_front())
    {
        m_flights.front().second.wait();
        m_octree->frameDone(m_flights.front().first);
    }
}

void EditMachine::compare()
{
    for (int attempt = 0; attempt < kAttemptsMax && !m_commands.empty(); ++attempt)
    {
        submit(false);
        wait(0);
    }
    RC_ASSERT(m_commands.empty());
    wait(0);
    if (m_octree->needsUpdate()) // after a frame that was lost
    {
        const std::uint64_t frame = m_octree->beginFrame();
        m_device.run([&](vk::FrameGraph& graph) { m_octree->update(graph); });
        m_octree->frameDone(frame);
    }
    RC_ASSERT(m_octree->edits().undoCount() == m_at);
    RC_ASSERT(m_octree->edits().redoCount() == m_line.size() - 1 - m_at);
    RC_ASSERT(m_octree->edits().voxelCount() == model().voxelCount());
    const std::string what = difference(cellsOf(m_device, m_octree->tree()), model().cells());
    if (!what.empty())
    {
        RC_FAIL(what);
    }
}

void EditMachine::finish()
{
    compare();
    for (const EditCommand::Action action : {EditCommand::Action::Undo, EditCommand::Action::Redo})
    {
        const bool undo = action == EditCommand::Action::Undo;
        while (undo ? m_at != 0 : m_at + 1 != m_line.size())
        {
            m_commands.push_back({action, {}});
            compare();
        }
    }
}

} // namespace zvo::test
