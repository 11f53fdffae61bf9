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
      m_root_slots(kStatic + setup.nodes)
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
    const std::uint64_t id = m_history.push(region, layers);
    m_updates.push_back({id, m_frames.back().number, writer, m_entries[m_current], succeeds, root.region});
    m_truth[id] = root;
    m_told[id] = {writer, layers};
    pushed(id);
}

void HistoryMachine::showStatic()
{
    const std::uint64_t id = m_history.push(std::nullopt, {});
    m_shown = {};
    m_truth[id] = {};
    m_told[id] = {};
    pushed(id);
}

void HistoryMachine::move(bool back)
{
    const std::optional<RootEntry> entry = back ? m_history.undo() : m_history.redo();
    RC_ASSERT(entry.has_value() == (back ? m_current > 0 : m_current + 1 < m_entries.size()));
    if (entry)
    {
        m_current += back ? std::size_t(-1) : 1;
        m_shown = entry->region ? m_root_slots[entry->region->first_node] : Root{};
        RC_ASSERT(m_shown == m_truth[m_entries[m_current]]);
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
    m_entries = m_before.entries;
    m_current = m_before.current;
    m_shown = m_truth[m_entries[m_current]];
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
        for (Update& later : m_updates)
        {
            later.before = later.before == update.id ? update.before : later.before;
        }
        removeFailed(m_entries, m_current, update);
        removeFailed(m_before.entries, m_before.current, update);
    }
    RC_ASSERT(m_history.entryBytes() == bytesOfEntries());
}

void HistoryMachine::checkEnd()
{
    while (m_current > 0)
    {
        move(true);
    }
    while (m_current + 1 < m_entries.size())
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
    RC_ASSERT(m_history.undoCount() == m_current);
    RC_ASSERT(m_history.redoCount() == m_entries.size() - 1 - m_current);
    checkCurrent();
    RC_ASSERT(isIntact(m_shown.writer, m_shown.region));
    for (const Frame& frame : m_frames)
    {
        for (const auto& [writer, region] : frame.regions)
        {
            RC_ASSERT(isIntact(writer, region));
        }
    }
    for (const std::uint64_t id : m_entries)
    {
        RC_ASSERT(isIntact(m_truth[id].writer, m_truth[id].region));
    }
    m_frames.back().regions.emplace(m_shown.writer, m_shown.region); // the frame traces what is shown
    checkLayers();
}

void HistoryMachine::beginFrame()
{
    m_frames.push_back({m_frame_list.begin(), {}});
    m_before = {m_entries, m_current};
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

std::set<int> HistoryMachine::writersOfEntries()
{
    std::set<int> writers;
    for (const std::uint64_t id : m_entries)
    {
        if (const int writer = m_told[id].writer; writer != 0)
        {
            writers.insert(writer);
        }
    }
    return writers;
}

// Removes a failed entry, or replaces it by the entry before it if that no longer precedes it. Entries that were
// dropped for it stay dropped.
void HistoryMachine::removeFailed(std::vector<std::uint64_t>& entries, std::size_t& current, const Update& update)
{
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
        if (entries[i] == update.id && entries[i - 1] == update.before)
        {
            entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(i));
            current -= current >= i ? 1 : 0;
        }
        else if (entries[i] == update.id)
        {
            entries[i] = update.before;
        }
    }
}

std::uint64_t HistoryMachine::bytesOfEntries()
{
    std::uint64_t bytes = 0;
    for (const int writer : writersOfEntries())
    {
        bytes += m_arena.bytes(m_owned[writer]);
    }
    return bytes;
}

// Whether the region would fit if only the entries held regions.
bool HistoryMachine::fitsBesideEntries(std::uint32_t nodes, std::uint32_t voxels)
{
    std::vector<bool> free_nodes(m_node_writers.size(), true);
    std::vector<bool> free_blocks(m_block_writers.size(), true);
    std::fill_n(free_nodes.begin(), kStatic, false);
    for (const int writer : writersOfEntries())
    {
        const OverlayRegion& region = m_owned[writer];
        std::fill_n(free_nodes.begin() + region.first_node, region.node_capacity, false);
        std::fill_n(free_blocks.begin() + region.first_voxel / kVoxelBlock, region.voxel_capacity / kVoxelBlock, false);
    }
    const auto has_run = [](const std::vector<bool>& line, std::size_t length)
    { return length == 0 || std::search_n(line.begin(), line.end(), length, true) != line.end(); };
    return has_run(free_nodes, nodes) && has_run(free_blocks, (voxels + 31) / 32);
}

bool HistoryMachine::dropEntry()
{
    if (m_current + 1 < m_entries.size())
    {
        m_entries.pop_back();
        return true;
    }
    if (m_current > 1)
    {
        m_entries.erase(m_entries.begin() + 1);
        --m_current;
        return true;
    }
    return false;
}

std::optional<OverlayRegion> HistoryMachine::allocate(std::uint32_t nodes, std::uint32_t voxels)
{
    RC_ASSERT(m_history.fitsLater(nodes, voxels) == fitsBesideEntries(nodes, voxels));
    const bool nothing_waits = m_history.waitingBytes() == 0;
    const std::size_t count = m_entries.size();
    const std::optional<OverlayRegion> region = m_history.allocate(nodes, voxels);
    const std::size_t dropped = count - (m_history.undoCount() + m_history.redoCount() + 1);
    for (std::size_t i = 0; i < dropped; ++i)
    {
        RC_ASSERT(!fitsBesideEntries(nodes, voxels)); // dropping this entry was necessary
        RC_ASSERT(dropEntry());
        m_line_changed = true;
    }
    if (region)
    {
        return region;
    }
    if (fitsBesideEntries(nodes, voxels))
    {
        RC_ASSERT(dropped != 0u || !nothing_waits);
        return region;
    }
    RC_ASSERT(dropped == 0u); // nothing was dropped, because dropping everything would not have helped:
    const std::vector<std::uint64_t> entries = m_entries;
    const std::size_t current = m_current;
    while (dropEntry())
    {
        RC_ASSERT(!fitsBesideEntries(nodes, voxels));
    }
    m_entries = entries;
    m_current = current;
    return region;
}

void HistoryMachine::pushed(std::uint64_t id)
{
    m_line_changed = true;
    m_entries.resize(m_current + 1);
    m_entries.push_back(id);
    ++m_current;
    while ((m_entries.size() - 1 > m_bounds.entries_max || bytesOfEntries() > m_bounds.bytes_max) && dropEntry())
    {
    }
    RC_ASSERT(m_history.entryBytes() == bytesOfEntries());
}

void HistoryMachine::checkCurrent()
{
    const RootEntry entry = m_history.current();
    const Told& told = m_told[m_entries[m_current]];
    RC_ASSERT(entry.id == m_entries[m_current]);
    RC_ASSERT(std::equal(entry.layers.begin(), entry.layers.end(), told.layers.begin(), told.layers.end()));
    RC_ASSERT(entry.region == (told.writer != 0 ? std::optional(m_owned[told.writer]) : std::nullopt));
    RC_ASSERT(m_shown == m_truth[entry.id]);
    RC_ASSERT(entry.pending == std::any_of(m_updates.begin(), m_updates.end(),
                                           [&](const Update& update) { return update.id == entry.id; }));
    if (!entry.pending)
    {
        RC_ASSERT(m_shown.layers == told.layers); // the host's list of layers matches the device
    }
}

// Checks that the history knows exactly the layers that may be shown again.
void HistoryMachine::checkLayers()
{
    std::set<std::uint32_t> expected; // a layer's number is that of its writer
    for (const std::uint64_t id : m_entries)
    {
        expected.insert(static_cast<std::uint32_t>(m_told[id].writer));
    }
    for (const Update& update : m_updates)
    {
        expected.insert(static_cast<std::uint32_t>(m_told[update.before].writer));
    }
    for (const std::uint64_t id : m_line_changed ? m_before.entries : std::vector<std::uint64_t>{})
    {
        expected.insert(static_cast<std::uint32_t>(m_told[id].writer));
    }
    expected.erase(0);
    std::set<std::uint32_t> seen;
    m_history.forEachLayer([&](const LayerState& state) { seen.insert(state.layer); });
    RC_ASSERT(seen == expected);
}

} // namespace zvo::test
