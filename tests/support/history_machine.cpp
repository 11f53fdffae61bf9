// SPDX-License-Identifier: MIT
#include "support/history_machine.h"

#include <rapidcheck.h>

#include <algorithm>

namespace zvo::test
{

HistoryMachine::HistoryMachine(const Setup& setup)
    : m_bounds(setup.bounds), m_arena({.static_nodes = kStatic,
                                       .node_capacity = kStatic + setup.nodes,
                                       .voxel_capacity = setup.blocks * kVoxelBlock,
                                       .node_bytes = 3,
                                       .voxel_block_bytes = 5}),
      m_history(m_arena, setup.bounds), m_node_writers(kStatic + setup.nodes), m_block_writers(setup.blocks),
      m_root_slots(kStatic + setup.nodes), m_line(setup.bounds.entries_max), m_before(m_line)
{
    beginFrame();
}

void HistoryMachine::update(std::uint32_t nodes, std::uint32_t voxels, std::uint32_t used, bool succeeds)
{
    const std::optional<OverlayRegion> region = allocate(nodes, voxels);
    if (!region)
    {
        return;
    }
    const int writer = ++m_writer_count;
    mark(*region, writer);
    m_owned[writer] = *region;
    m_frames.back().regions.emplace(writer, *region);

    const auto kept = std::make_shared<const int>(writer);
    m_kept[writer] = kept;
    const std::vector<LayerState> layers = {{static_cast<std::uint32_t>(writer), used}};
    Root root{writer, *region, layers};
    root.region.node_capacity = 1 + used % nodes;
    root.region.voxel_capacity = (used % (voxels / kVoxelBlock + 1)) * kVoxelBlock;
    if (!succeeds)
    {
        root = m_shown;
    }
    m_root_slots[region->first_node] = root;
    m_shown = root;
    const std::uint64_t id = m_history.push(region, {{layers.front().layer, layers.front().version, kept}});
    m_updates.push_back({id, m_frames.back().number, writer, succeeds, root.region});
    push(id, {root, writer, layers});
}

void HistoryMachine::showStatic()
{
    m_shown = {};
    push(m_history.push(std::nullopt, {}), {});
}

void HistoryMachine::move(bool back)
{
    const std::optional<RootEntry> entry = back ? m_history.undo() : m_history.redo();
    RC_ASSERT(entry.has_value() == m_line.move(back ? -1 : 1));
    if (entry)
    {
        m_shown = entry->region ? m_root_slots[entry->region->first_node] : Root{};
        checkCurrent();
    }
}

void HistoryMachine::giveUp(std::uint32_t nodes, std::uint32_t voxels)
{
    if (const std::optional<OverlayRegion> region = allocate(nodes, voxels))
    {
        mark(*region, ++m_writer_count);
        m_frames.back().regions.emplace(m_writer_count, *region);
        m_history.giveBack(*region);
    }
}

void HistoryMachine::nextFrame()
{
    beginFrame();
    check();
}

void HistoryMachine::loseFrame()
{
    const std::uint64_t frame = m_frames.back().number;
    while (!m_updates.empty() && m_updates.back().frame == frame)
    {
        m_updates.pop_back();
    }
    m_frame_list.lost();
    m_line.takeBack(m_before);
    m_shown = m_line.shown().truth;
    nextFrame();
}

void HistoryMachine::finishFrame()
{
    if (m_frames.size() > 1)
    {
        m_frame_done = m_frames.front().number;
        m_frame_list.done(m_frame_done);
        m_frames.pop_front();
    }
}

void HistoryMachine::endUpdate()
{
    if (m_updates.empty() || m_updates.front().frame > m_frame_done)
    {
        return;
    }
    const Update update = m_updates.front();
    m_updates.pop_front();
    if (update.succeeds)
    {
        m_owned[update.writer].node_capacity = update.used.node_capacity;
        m_owned[update.writer].voxel_capacity = update.used.voxel_capacity;
        m_history.complete(update.id, update.used.node_capacity, update.used.voxel_capacity);
    }
    else
    {
        m_history.fail(update.id);
    }
    m_line.end(update.id, !update.succeeds);
    m_before.end(update.id, !update.succeeds);
    RC_ASSERT(m_history.entryBytes() == bytesOfEntries());
}

void HistoryMachine::checkEnd()
{
    while (m_line.undoCount() != 0)
    {
        move(true);
    }
    while (m_line.redoCount() != 0)
    {
        move(false);
    }
    while (!m_updates.empty())
    {
        nextFrame();
        finishFrame();
        endUpdate();
        check();
    }
    while (m_frames.size() > 1)
    {
        finishFrame();
    }
    m_frame_list.done(m_frames.back().number);
    RC_ASSERT(m_history.entryBytes() == bytesOfEntries());
    RC_ASSERT(m_history.waitingBytes() == 0u);
    RC_ASSERT(m_arena.heldBytes() == bytesOfEntries());
}

void HistoryMachine::check()
{
    RC_ASSERT(m_history.undoCount() == m_line.undoCount());
    RC_ASSERT(m_history.redoCount() == m_line.redoCount());
    checkCurrent();
    RC_ASSERT(isIntact(m_shown.writer, m_shown.region));
    for (const Frame& frame : m_frames)
    {
        for (const auto& [writer, region] : frame.regions)
        {
            RC_ASSERT(isIntact(writer, region));
        }
    }
    for (const std::uint64_t id : m_line.entries())
    {
        const Root& truth = m_line.shown(id).truth;
        RC_ASSERT(isIntact(truth.writer, truth.region));
    }
    m_frames.back().regions.emplace(m_shown.writer, m_shown.region); // the frame traces what is shown
    checkLayers();
}

void HistoryMachine::beginFrame()
{
    m_frames.push_back({m_frame_list.begin(), {}});
    m_before = m_line;
    m_line_changed = false;
}

void HistoryMachine::mark(const OverlayRegion& region, int writer)
{
    std::fill_n(m_node_writers.begin() + region.first_node, region.node_capacity, writer);
    std::fill_n(m_block_writers.begin() + region.first_voxel / kVoxelBlock, region.voxel_capacity / kVoxelBlock,
                writer);
}

// Whether the region has not been given to another writer since.
bool HistoryMachine::isIntact(int writer, const OverlayRegion& region) const
{
    const auto is_writers = [&](int w) { return w == writer; };
    const auto node = m_node_writers.begin() + region.first_node;
    const auto block = m_block_writers.begin() + region.first_voxel / kVoxelBlock;
    return std::all_of(node, node + region.node_capacity, is_writers) &&
           std::all_of(block, block + region.voxel_capacity / kVoxelBlock, is_writers);
}

std::set<int> HistoryMachine::writersOf(const Line& line)
{
    std::set<int> writers;
    for (const std::uint64_t id : line.entries())
    {
        writers.insert(line.shown(id).writer);
    }
    writers.erase(0);
    return writers;
}

std::uint64_t HistoryMachine::bytesOfEntries()
{
    std::uint64_t bytes = 0;
    for (const int writer : writersOf(m_line))
    {
        bytes += m_arena.bytes(m_owned[writer]);
    }
    return bytes;
}

// Whether the region would fit if only the entries of line held regions.
bool HistoryMachine::fitsBeside(const Line& line, std::uint32_t nodes, std::uint32_t voxels)
{
    std::vector<bool> free_nodes(m_node_writers.size(), true);
    std::vector<bool> free_blocks(m_block_writers.size(), true);
    std::fill_n(free_nodes.begin(), kStatic, false);
    for (const int writer : writersOf(line))
    {
        const OverlayRegion& region = m_owned[writer];
        std::fill_n(free_nodes.begin() + region.first_node, region.node_capacity, false);
        std::fill_n(free_blocks.begin() + region.first_voxel / kVoxelBlock, region.voxel_capacity / kVoxelBlock, false);
    }
    const auto has_run = [](const std::vector<bool>& free, std::size_t length)
    { return length == 0 || std::search_n(free.begin(), free.end(), length, true) != free.end(); };
    return has_run(free_nodes, nodes) && has_run(free_blocks, (voxels + 31) / 32);
}

std::optional<OverlayRegion> HistoryMachine::allocate(std::uint32_t nodes, std::uint32_t voxels)
{
    RC_ASSERT(m_history.fitsLater(nodes, voxels) == fitsBeside(m_line, nodes, voxels));
    const bool nothing_waits = m_history.waitingBytes() == 0;
    const std::optional<OverlayRegion> region = m_history.allocate(nodes, voxels);
    bool has_dropped = false;
    for (; m_line.entries().size() > m_history.undoCount() + m_history.redoCount() + 1; has_dropped = true)
    {
        RC_ASSERT(!fitsBeside(m_line, nodes, voxels)); // dropping this entry was necessary
        m_line.drop();
        m_line_changed = true;
    }
    if (region)
    {
        return region;
    }
    if (fitsBeside(m_line, nodes, voxels))
    {
        RC_ASSERT(has_dropped || !nothing_waits);
        return region;
    }
    RC_ASSERT(!has_dropped); // nothing was dropped, because dropping everything would not have helped:
    Line shorter = m_line;
    while (shorter.canDrop())
    {
        shorter.drop();
        RC_ASSERT(!fitsBeside(shorter, nodes, voxels));
    }
    return region;
}

// An entry was pushed. The oldest ones fall off beyond the bounds.
void HistoryMachine::push(std::uint64_t id, const Entry& entry)
{
    m_line_changed = true;
    m_line.push(entry, entry.writer != 0);
    RC_ASSERT(m_line.current() == id);
    while (bytesOfEntries() > m_bounds.bytes_max && m_line.canDrop())
    {
        m_line.drop();
    }
    RC_ASSERT(m_history.entryBytes() == bytesOfEntries());
}

void HistoryMachine::checkCurrent()
{
    const RootEntry entry = m_history.current();
    const Entry& told = m_line.shown();
    RC_ASSERT(entry.id == m_line.current());
    RC_ASSERT(std::equal(entry.layers.begin(), entry.layers.end(), told.layers.begin(), told.layers.end()));
    RC_ASSERT(entry.region == (told.writer != 0 ? std::optional(m_owned[told.writer]) : std::nullopt));
    RC_ASSERT(m_shown == told.truth);
    RC_ASSERT(entry.pending == std::any_of(m_updates.begin(), m_updates.end(),
                                           [&](const Update& update) { return update.id == entry.id; }));
    if (!entry.pending)
    {
        RC_ASSERT(m_shown.layers == told.layers); // the host's list of layers matches the device
    }
}

// Checks that the history keeps exactly the layers that may be shown again, and those of updates under way.
void HistoryMachine::checkLayers()
{
    std::set<int> expected = writersOf(m_line); // a layer's number is that of its writer
    for (const auto& [entry, fallback] : m_line.pending())
    {
        expected.insert(m_line.shown(entry).writer);
        expected.insert(m_line.shown(fallback).writer);
    }
    if (m_line_changed)
    {
        expected.merge(writersOf(m_before));
    }
    expected.erase(0);
    std::erase_if(m_kept, [](const auto& entry) { return entry.second.expired(); });
    RC_ASSERT(std::ranges::equal(m_kept, expected, {}, [](const auto& entry) { return entry.first; }));
}

} // namespace zvo::test
