// SPDX-License-Identifier: MIT
#include "support/dynamic_machine.h"

#include "support/machine_limits.h"
#include "support/tree_words.h"
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

const Cell* findCell(const std::vector<Cell>& cells, const Cell& cell)
{
    const auto order = [](const Cell& c) { return std::pair(c.level, c.code); };
    const auto found = std::ranges::lower_bound(cells, order(cell), {}, order);
    return found != cells.end() && order(*found) == order(cell) ? &*found : nullptr;
}

} // namespace

DynamicMachine::DynamicMachine(vk::HeadlessDevice& device, const DynamicSetting& setting, DynamicScenery& scenery)
    : m_device(device), m_setting(setting), m_scenery(scenery), m_paths(device.device(), setting.compressed),
      m_camera(setting.camera()), m_line(setting.entries_max)
{
    m_setting.shot.coarse = setting.shot.coarse && !isRuled(); // the rule does not define averages of mixed nodes
    for (std::uint32_t i = 0; i < setting.frames_in_flight; ++i)
    {
        m_takers.emplace_back(device.device());
    }
    DeviceTree built = scenery.buildStatic(setting);
    m_static_emissive = built.emission.count();
    m_static = staticWords(device, built, built.nodes.count(), m_static_emissive);
    m_octree = std::make_unique<DynamicOctree>(device, std::move(built), setting.options(scenery.emissionScale()));
    see(m_line.current(), picturesOf(m_octree->tree()));
}

void DynamicMachine::run(const Command& command)
{
    switch (command.action)
    {
    case Command::Action::Add:
        add(command.item);
        break;
    case Command::Action::Submit:
    case Command::Action::Lose:
        submit(command.action == Command::Action::Lose);
        break;
    case Command::Action::Wait:
        wait();
        compare();
        break;
    case Command::Action::Settle:
        settle();
        break;
    default:
        if (m_update_count == kUpdatesPerFrame)
        {
            submit();
        }
        m_update_count += command.action == Command::Action::Update || command.action == Command::Action::Slice ? 1 : 0;
        m_commands.push_back(command);
    }
}

void DynamicMachine::finish()
{
    settle();
    while (m_line.undoCount() != 0)
    {
        m_commands.push_back({.action = Command::Action::Undo});
        wait();
    }
    compare();
    RC_ASSERT(m_octree->tree().isDag() == m_setting.compressed);
    RC_ASSERT(staticWords(m_device, m_octree->tree(), m_octree->staticRoot(), m_static_emissive) == m_static);
}

void DynamicMachine::add(const Item& item)
{
    submit();
    if (m_wanted.size() < kObjectsMax)
    {
        const Item added = {item.mesh, item.placement, item.mesh < DynamicScenery::kRigidCount ? 0 : item.bend};
        const std::shared_ptr<const DynamicMesh> mesh = m_scenery.object(added.mesh, m_setting.attributes);
        DynamicObjectId id = 0;
        while (!mayFail([&] { id = m_octree->add(mesh, m_scenery.poseOf(added)); }))
        {
        }
        m_wanted[id] = added;
    }
}

void DynamicMachine::setFailures(std::function<void()> arm, std::function<void()> disarm)
{
    m_arm = std::move(arm);
    m_disarm = std::move(disarm);
}

// Calls call(), and returns whether it succeeded. fails: call() throws even if nothing is armed.
bool DynamicMachine::mayFail(const std::function<void()>& call, bool fails)
{
    if (!m_arm && !fails)
    {
        call();
        return true;
    }
    bool succeeds = true;
    try
    {
        m_arm ? m_arm() : void();
        call();
    }
    catch (const Error&)
    {
        succeeds = false;
        ++m_failure_count;
    }
    m_disarm ? m_disarm() : void();
    return succeeds;
}

// Submits the commands so far as a frame. Waits for the oldest frame first if too many are under way.
// loses: the frame fails. Commands to dynamic objects keep their effect then; the line becomes what it was before.
void DynamicMachine::submit(bool loses)
{
    if (m_commands.empty())
    {
        return;
    }
    if (m_flights.size() == m_setting.frames_in_flight)
    {
        waitForOldest();
    }
    const std::uint64_t frame = m_octree->beginFrame();
    const HistoryLine<Shown> before = m_line;
    ShotTaker& taker = freeTaker();
    vk::Submission submission;
    m_has_recorded = false;
    if (mayFail([&] { submission = submitFrame(taker, loses); }, loses))
    {
        m_flights.push_back({frame, m_line.current(), &taker, std::move(submission)});
    }
    else
    {
        m_octree->frameLost();
        m_line.takeBack(before);
        m_is_owed = m_is_owed || m_has_recorded;
        RC_ASSERT(!m_is_owed || m_octree->isUpdating() || m_octree->needsUpdate());
    }
    m_commands.clear();
    m_update_count = 0;
}

// A taker whose pictures are not those of a frame in flight. Frame numbers cannot select it, because some frames are
// lost.
ShotTaker& DynamicMachine::freeTaker()
{
    const auto is_free = [&](const ShotTaker& taker)
    { return std::ranges::none_of(m_flights, [&](const Flight& flight) { return flight.taker == &taker; }); };
    return *std::ranges::find_if(m_takers, is_free);
}

vk::Submission DynamicMachine::submitFrame(ShotTaker& taker, bool loses)
{
    return m_device.submit(
        [&](vk::FrameGraph& graph)
        {
            for (const Command& command : m_commands)
            {
                record(graph, command);
            }
            taker.record(graph, m_octree->tree(), m_paths, m_camera, m_setting.shot);
            graph.releaseToHost();
            if (loses)
            {
                throw Error(ErrorCode::Other, "the frame is lost");
            }
        });
}

void DynamicMachine::record(vk::FrameGraph& graph, const Command& command)
{
    const auto object =
        m_wanted.empty() ? m_wanted.end() : std::next(m_wanted.begin(), command.object % std::ssize(m_wanted));
    switch (command.action)
    {
    case Command::Action::Move:
    case Command::Action::Bend:
        if (object != m_wanted.end())
        {
            Item& item = object->second;
            item.placement = command.action == Command::Action::Bend ? item.placement : command.item.placement;
            item.bend = item.mesh < DynamicScenery::kRigidCount ? 0 : command.item.bend;
            m_octree->setPose(object->first, m_scenery.poseOf(item));
        }
        break;
    case Command::Action::Remove:
        if (object != m_wanted.end())
        {
            m_octree->remove(object->first);
            m_wanted.erase(object);
            m_is_owed = false; // the update under way is given up
        }
        break;
    case Command::Action::Update:
        update(graph, 0);
        break;
    case Command::Action::Slice:
        update(graph, kTinyBudgetMs);
        break;
    case Command::Action::Undo:
    case Command::Action::Redo:
        show(graph, command.action == Command::Action::Undo);
        break;
    default:
        break;
    }
}

void DynamicMachine::update(vk::FrameGraph& graph, double budget_ms)
{
    if (!m_octree->isUpdating())
    {
        m_under_way = m_wanted;
    }
    m_has_recorded = true;
    const bool is_complete = m_octree->update(graph, budget_ms);
    const bool waits = m_arm && !is_complete && !m_octree->isUpdating(); // for memory that frames in flight still hold
    RC_ASSERT(!waits || m_octree->needsUpdate());
    RC_ASSERT(waits || is_complete == !m_octree->isUpdating());
    RC_ASSERT(waits || is_complete || budget_ms != 0);
    m_is_owed = !is_complete;
    if (is_complete)
    {
        m_line.push(m_under_way, !m_under_way.empty());
    }
    const RootHistory& history = m_octree->history();
    while (m_arm && (m_line.undoCount() > history.undoCount() || m_line.redoCount() > history.redoCount()))
    {
        m_line.drop();
    }
}

void DynamicMachine::show(vk::FrameGraph& graph, bool undo)
{
    const bool moved = m_line.move(undo ? -1 : 1);
    RC_ASSERT((undo ? m_octree->undo(graph) : m_octree->redo(graph)) == moved);
    if (moved)
    {
        m_has_recorded = true;
        m_is_owed = false;
        m_wanted = m_line.shown();
    }
}

void DynamicMachine::waitForOldest()
{
    const std::uint64_t frame = m_flights.front().frame;
    const std::uint64_t entry = m_flights.front().entry;
    const ShotTaker* taker = m_flights.front().taker;
    std::vector<vk::PassTime> passes;
    mayFail([&] { passes = m_flights.front().submission.wait(); }); // the frame is done even if the wait fails
    for (const UpdateReport& report : m_octree->frameDone(frame, passes))
    {
        m_is_owed = m_is_owed || (report.failed != 0 && report.entry == m_line.current());
        m_line.end(report.entry, report.failed != 0);
    }
    m_flights.pop_front();
    see(m_line.endedAs(entry), taker->pictures());
    RC_ASSERT(!m_is_owed || m_octree->isUpdating() || m_octree->needsUpdate());
}

void DynamicMachine::wait()
{
    submit();
    while (!m_flights.empty())
    {
        waitForOldest();
    }
    RC_ASSERT(!m_line.isPending());
}

void DynamicMachine::settle()
{
    wait();
    for (int attempt = 0; attempt < kAttemptsMax; ++attempt)
    {
        m_commands.push_back({.action = Command::Action::Update});
        wait();
        compare();
        if (!m_octree->needsUpdate() && m_line.shown() == m_wanted)
        {
            return;
        }
    }
    RC_FAIL("no update succeeded");
}

void DynamicMachine::compare()
{
    RC_ASSERT(m_octree->history().undoCount() == m_line.undoCount());
    RC_ASSERT(m_octree->history().redoCount() == m_line.redoCount());
    std::multiset<Item> items;
    for (const auto& [id, item] : m_line.shown())
    {
        items.insert(item);
    }
    std::vector<Cell> actual = cellsOf(m_device, m_octree->tree());
    const std::shared_ptr<const Rebuilt> rebuilt = m_scenery.rebuilt(m_setting, true, items);
    std::vector<Cell> expected = rebuilt->cells;
    if (isRuled())
    {
        applyRule(expected, actual, m_scenery.rebuilt(m_setting, true, {})->cells,
                  m_scenery.rebuilt(m_setting, false, items)->cells);
    }
    const std::string what = difference(actual, expected);
    if (!what.empty())
    {
        RC_FAIL(what);
    }
    const auto [pictures, is_new] = m_expected.try_emplace(items);
    if (is_new && isRuled())
    {
        pictures->second = picturesOf(octreeOf(m_device, expected, m_setting.grid(), m_scenery.emissionScale()));
    }
    else if (is_new)
    {
        pictures->second = picturesOf(rebuilt->octree);
    }
    if (m_pictures.at(m_line.current()) != pictures->second)
    {
        RC_FAIL("the pictures are not those of an octree that is made anew");
    }
}

// Compares a frame's pictures with those that its entry had first, or keeps them as the first.
void DynamicMachine::see(std::uint64_t entry, Pixels pixels)
{
    const auto [first, is_new] = m_pictures.try_emplace(entry, std::move(pixels));
    if (!is_new && first->second != pixels)
    {
        RC_FAIL("entry " + std::to_string(entry) + " has other pictures than when it was seen first");
    }
}

DynamicMachine::Pixels DynamicMachine::picturesOf(const DeviceTree& tree)
{
    ShotTaker& taker = m_takers.front();
    Shot shot = m_setting.shot;
    shot.beam = false; // does not change the pictures, which are compared with those of either kind
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            taker.record(graph, tree, m_paths, m_camera, shot);
            graph.releaseToHost();
        });
    return taker.pictures();
}

// Replaces the attributes of expected cells as the merge rule says: a cell of one part has that part's attributes.
// Nodes of both parts are left out of the comparison, which still covers everything below them.
void DynamicMachine::applyRule(std::vector<Cell>& expected, std::vector<Cell>& actual, const std::vector<Cell>& fixed,
                               const std::vector<Cell>& moving) const
{
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        const Cell* in_fixed = findCell(fixed, expected[i]);
        const Cell* in_moving = findCell(moving, expected[i]);
        RC_ASSERT(in_fixed != nullptr || in_moving != nullptr);
        if (in_fixed == nullptr || in_moving == nullptr)
        {
            expected[i] = in_fixed != nullptr ? *in_fixed : *in_moving;
        }
        else if (expected[i].level == m_setting.grid().nodeLevels())
        {
            expected[i] = m_setting.merge == MergeRule::DynamicWins ? *in_moving : *in_fixed;
        }
        else
        {
            expected[i].attribute = {};
            if (i < actual.size())
            {
                actual[i].attribute = {};
            }
        }
    }
}

} // namespace zvo::test
