// SPDX-License-Identifier: MIT
#include "support/edit_machine.h"

#include "oracle/morton.h"
#include "runtime/copy_voxels.h"
#include "support/machine_limits.h"

#include "zvo/error.h"

#include <rapidcheck.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

namespace zvo::test
{

namespace
{

bool isUpdate(const Command& command)
{
    return command.action == Command::Action::Update || command.action == Command::Action::Slice;
}

} // namespace

EditMachine::EditMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, const HistoryBounds& bounds,
                         DynamicScenery& scenery)
    : m_device(device), m_setting(setting), m_scenery(scenery), m_entries_max(bounds.entries_max)
{
    DynamicOptions options = setting.options(scenery.emissionScale());
    options.edits = bounds;
    m_octree = std::make_unique<DynamicOctree>(device, scenery.buildStatic(setting), options);
    m_line.emplace_back(setting.grid(), cellsOf(device, m_octree->tree()), setting.attributes, setting.filled);
}

void EditMachine::run(const Command& command)
{
    using Action = Command::Action;
    switch (command.action)
    {
    case Action::Submit:
        submit();
        break;
    case Action::Lose:
        submit(Fate::Lose);
        break;
    case Action::LoseRun:
        submit(Fate::LoseRun);
        break;
    case Action::Add:
        add(command.item);
        break;
    case Action::Settle:
        compare();
        break;
    default:
        m_commands.push_back(command);
        if (m_commands.size() >= kDabsPerFrameMax || std::ranges::count_if(m_commands, isUpdate) >= kUpdatesPerFrame)
        {
            submit();
        }
    }
}

void EditMachine::add(const Item& item)
{
    submit();
    if (m_wanted.size() < kObjectsMax)
    {
        const Item added = {item.mesh, item.placement, item.mesh < DynamicScenery::kRigidCount ? 0 : item.bend};
        const std::shared_ptr<const DynamicMesh> mesh = m_scenery.object(added.mesh, m_setting.attributes);
        m_wanted[m_octree->add(mesh, m_scenery.poseOf(added))] = added;
    }
}

// Returns whether the octree has recorded the dab; if not, it must be tried again.
bool EditMachine::dab(vk::FrameGraph& graph, const Brush& brush)
{
    const std::uint64_t before = m_octree->edits().changeCount();
    Brush used = brush;
    used.emission *= m_octree->tree().emission_scale;
    const bool is_done = m_octree->edit(graph, used);
    dropForgotten();
    if (!is_done || m_octree->edits().changeCount() == before) // the brush covers nothing of the grid
    {
        m_shown = m_octree->edits().changeCount() == before ? m_shown : Objects{};
        return is_done;
    }
    m_shown = Objects{};
    EditModel edited = m_line[m_at];
    edited.apply(brush, m_octree->tree().emission_words.count() != 0);
    m_line.resize(m_at + 1, edited);
    if (m_is_stroke)
    {
        m_line.back() = std::move(edited);
    }
    else
    {
        m_line.push_back(std::move(edited));
    }
    if (m_line.size() - 1 > m_entries_max)
    {
        m_line.erase(m_line.begin());
    }
    m_at = m_line.size() - 1;
    m_is_stroke = true;
    return true;
}

// Drops the entries that the octree has dropped to make room.
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

// Records as many commands as a frame takes; the others are recorded in a later one.
void EditMachine::record(vk::FrameGraph& graph)
{
    int update_count = 0;
    for (std::uint32_t i = 0; i < kDabsPerFrameMax && !m_commands.empty(); ++i, m_commands.pop_front())
    {
        update_count += isUpdate(m_commands.front()) ? 1 : 0;
        if (update_count > kUpdatesPerFrame || !recordOne(graph, m_commands.front()))
        {
            return;
        }
    }
}

// Returns false if the command must be tried again.
bool EditMachine::recordOne(vk::FrameGraph& graph, const Command& command)
{
    using Action = Command::Action;
    switch (command.action)
    {
    case Action::Dab:
        return dab(graph, command.brush);
    case Action::EndStroke:
        m_octree->endStroke();
        m_is_stroke = false;
        break;
    case Action::Undo:
    case Action::Redo:
    {
        const bool undo = command.action == Action::Undo;
        const bool moves = undo ? m_at != 0 : m_at + 1 != m_line.size();
        RC_ASSERT((undo ? m_octree->undoEdit(graph) : m_octree->redoEdit(graph)) == moves);
        m_at += moves ? (undo ? -1 : 1) : 0;
        m_shown = moves ? Objects{} : m_shown;
        m_is_stroke = false;
        break;
    }
    case Action::Update:
        update(graph, 0);
        break;
    case Action::Slice:
        update(graph, kTinyBudgetMs);
        break;
    default:
        move(command);
    }
    return true;
}

void EditMachine::move(const Command& command)
{
    if (m_wanted.empty())
    {
        return;
    }
    const auto object = std::next(m_wanted.begin(), command.object % std::ssize(m_wanted));
    if (command.action == Command::Action::Move)
    {
        Item& item = object->second;
        item.placement = command.item.placement;
        item.bend = item.mesh < DynamicScenery::kRigidCount ? 0 : command.item.bend;
        m_octree->setPose(object->first, m_scenery.poseOf(item));
    }
    else
    {
        m_octree->remove(object->first);
        m_wanted.erase(object);
    }
}

void EditMachine::update(vk::FrameGraph& graph, double budget_ms)
{
    if (!m_octree->isUpdating())
    {
        m_under_way = m_wanted;
    }
    const bool is_complete = m_octree->update(graph, budget_ms);
    RC_ASSERT(is_complete == !m_octree->isUpdating());
    m_shown = is_complete ? m_under_way : m_shown;
}

void EditMachine::submit(Fate fate)
{
    if (m_commands.empty())
    {
        return;
    }
    wait(m_setting.frames_in_flight - 1);
    const std::uint64_t frame = m_octree->beginFrame();
    const Line before = {m_line, m_at};
    if (fate == Fate::Submit)
    {
        m_flights.emplace_back(frame, m_device.submit(
                                          [&](vk::FrameGraph& graph)
                                          {
                                              record(graph);
                                              graph.releaseToHost();
                                          }));
        return;
    }
    try
    {
        m_device.run(
            [&](vk::FrameGraph& graph)
            {
                record(graph);
                if (fate == Fate::Lose)
                {
                    throw Error(ErrorCode::Other, "the frame is lost");
                }
            });
    }
    catch (const Error&)
    {
        RC_ASSERT(fate == Fate::Lose);
    }
    m_commands.clear();
    m_octree->frameLost();
    m_line = before.line;
    m_at = before.at;
    m_is_stroke = false;
    m_shown.reset();
    dropForgotten();
}

void EditMachine::wait(std::size_t flights_left)
{
    for (; m_flights.size() > flights_left; m_flights.pop_front())
    {
        m_flights.front().second.wait();
        for (const UpdateReport& report : m_octree->frameDone(m_flights.front().first))
        {
            if (report.failed != 0)
            {
                m_shown.reset();
            }
        }
    }
}

void EditMachine::compare()
{
    for (int attempt = 0; attempt < kAttemptsMax && !m_commands.empty(); ++attempt)
    {
        submit();
        wait(0);
    }
    RC_ASSERT(m_commands.empty());
    wait(0);
    RC_ASSERT(m_octree->edits().undoCount() == m_at);
    RC_ASSERT(m_octree->edits().redoCount() == m_line.size() - 1 - m_at);
    RC_ASSERT(m_octree->edits().voxelCount() == model().voxelCount());
    if (m_shown)
    {
        compareShown();
    }
    if (m_octree->needsUpdate() || m_shown != m_wanted)
    {
        settle();
        compareShown();
    }
}

// Updates until all dynamic objects show their last poses.
void EditMachine::settle()
{
    for (int attempt = 0; attempt < kAttemptsMax; ++attempt)
    {
        m_commands.push_back({Command::Action::Update});
        submit();
        wait(0);
        if (m_shown == m_wanted && !m_octree->needsUpdate())
        {
            return;
        }
    }
    RC_FAIL("no update succeeded");
}

void EditMachine::compareShown()
{
    std::multiset<Item> items;
    for (const auto& [id, item] : *m_shown)
    {
        items.insert(item);
    }
    const auto rebuilt = [&](bool with_static) { return m_scenery.rebuilt(m_setting, with_static, items)->cells; };
    const std::vector<Cell> expected =
        items.empty() ? model().cells() : model().merged(m_setting.merge, rebuilt(false), rebuilt(true)).cells();
    const std::string what = difference(cellsOf(m_device, m_octree->tree()), expected);
    if (!what.empty())
    {
        RC_FAIL(what);
    }
}

// Compares a copy of what may have been edited with the model.
void EditMachine::compareCopy()
{
    const auto edge = static_cast<int>(m_setting.grid().resolution());
    const glm::ivec3 lo(std::max(edge - 70, 0));
    const VoxelClip clip =
        copyVoxels(m_device, m_octree->tree(), m_octree->editedRoot(), {lo, glm::ivec3(edge - 1, edge - 1, edge - 2)});
    std::size_t count = 0;
    for (const auto& [code, voxel] : model().voxels())
    {
        const glm::ivec3 cell = glm::ivec3(oracle::mortonDecode(code)) - lo;
        if (glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) && cell.z < clip.size().z)
        {
            ++count;
            const std::optional<ClipVoxel>& copied = clip.at(cell);
            RC_ASSERT(copied.has_value());
            const gpu::Attribute look =
                m_setting.attributes ? model().lookOf(voxel) : gpu::Attribute{0, gpu::kNoNormal};
            RC_ASSERT((*copied == ClipVoxel{look, voxel.emission}));
        }
    }
    RC_ASSERT(clip.voxelCount() == count);
}

void EditMachine::finish()
{
    compare();
    for (const Command::Action action : {Command::Action::Undo, Command::Action::Redo})
    {
        const bool undo = action == Command::Action::Undo;
        while (undo ? m_at != 0 : m_at + 1 != m_line.size())
        {
            m_commands.push_back({action});
            compare();
        }
    }
    compareCopy();
}

} // namespace zvo::test
