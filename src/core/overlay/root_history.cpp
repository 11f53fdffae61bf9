// SPDX-License-Identifier: MIT
#include "core/overlay/root_history.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <set>
#include <utility>

namespace zvo
{

RootHistory::RootHistory(OverlayArena& arena, const HistoryBounds& bounds) : m_arena(arena), m_bounds(bounds)
{
    assert(bounds.entries_max > 0);
    m_entries.push_back(makeEntry({}));
}

RootHistory::~RootHistory()
{
    m_updates.clear();
    m_entries.clear();
    m_entries_before.clear();
    frameDone(m_frame);
}

RootHistory::SharedEntry RootHistory::makeEntry(RootEntry&& entry)
{
    const auto drop = [this](RootEntry* dropped)
    {
        if (dropped->region)
        {
            giveBack(*dropped->region);
        }
        delete dropped;
    };
    return {new RootEntry(std::move(entry)), drop};
}

// Keeps the line as it is before its first change in a frame, for frameLost().
void RootHistory::keepEntries()
{
    if (m_entries_before.empty() && m_frame != m_frame_done)
    {
        m_entries_before = m_entries;
    }
}

void RootHistory::frameSubmitted()
{
    m_entries_before.clear();
    m_current_before = m_current;
}

void RootHistory::frameLost()
{
    while (!m_updates.empty() && m_updates.back().frame == m_frame)
    {
        m_updates.pop_back();
    }
    if (!m_entries_before.empty())
    {
        m_entries = std::exchange(m_entries_before, {});
    }
    m_current = m_current_before;
}

std::optional<OverlayRegion> RootHistory::allocate(std::uint64_t nodes, std::uint64_t voxels)
{
    if (const std::optional<OverlayRegion> region = m_arena.allocate(nodes, voxels))
    {
        return region;
    }
    // How many entries it takes is found out on a copy: none shall be dropped in vain.
    OverlayArena later = arenaLater();
    std::size_t end = m_entries.size();
    std::size_t first = 1;
    while (!later.allocate(nodes, voxels))
    {
        const RootEntry* entry = nullptr;
        if (end - 1 > m_current)
        {
            entry = m_entries[--end].get();
        }
        else if (first < m_current)
        {
            entry = m_entries[first++].get();
        }
        else
        {
            return std::nullopt;
        }
        if (entry->region)
        {
            later.release(*entry->region);
        }
    }
    keepEntries();
    for (std::size_t count = m_entries.size() - end + first - 1; count != 0; --count)
    {
        dropEntry();
    }
    return m_arena.allocate(nodes, voxels);
}

bool RootHistory::fitsLater(std::uint64_t nodes, std::uint64_t voxels) const
{
    return arenaLater().allocate(nodes, voxels).has_value();
}

// The arena as it will be when only the regions of the entries are held.
OverlayArena RootHistory::arenaLater() const
{
    OverlayArena later = m_arena;
    for (const Waiting& waiting : m_waiting)
    {
        later.release(waiting.region);
    }
    std::set<SharedEntry> seen(m_entries.begin(), m_entries.end());
    const auto release = [&](const SharedEntry& entry)
    {
        if (seen.insert(entry).second && entry->region)
        {
            later.release(*entry->region);
        }
    };
    for (const Update& update : m_updates)
    {
        release(update.entry);
        release(update.fallback);
    }
    std::ranges::for_each(m_entries_before, release);
    return later;
}

void RootHistory::giveBack(const OverlayRegion& region)
{
    if (m_frame == m_frame_done)
    {
        m_arena.release(region);
    }
    else
    {
        m_waiting.push_back({m_frame, region});
    }
}

std::uint64_t RootHistory::push(const std::optional<OverlayRegion>& region, std::vector<LayerState> layers)
{
    const SharedEntry entry = makeEntry({++m_last_id, region, std::move(layers), region.has_value()});
    if (region)
    {
        m_updates.push_back({entry, m_entries[m_current], m_frame});
    }
    keepEntries();
    m_entries.erase(m_entries.begin() + static_cast<std::ptrdiff_t>(m_current) + 1, m_entries.end());
    m_entries.push_back(entry);
    ++m_current;
    while ((m_entries.size() - 1 > m_bounds.entries_max || entryBytes() > m_bounds.bytes_max) && dropEntry())
    {
    }
    return m_last_id;
}

RootHistory::Update RootHistory::endUpdate([[maybe_unused]] std::uint64_t id)
{
    assert(!m_updates.empty() && m_updates.front().entry->id == id && "updates end once, in the order of pushes");
    Update update = std::move(m_updates.front());
    m_updates.pop_front();
    update.entry->pending = false;
    return update;
}

void RootHistory::complete(std::uint64_t id, std::uint32_t nodes, std::uint32_t voxels)
{
    const Update update = endUpdate(id);
    std::optional<OverlayRegion>& region = update.entry->region;
    region = m_arena.shrink(*region, nodes, voxels);
}

void RootHistory::fail(std::uint64_t id)
{
    const Update update = endUpdate(id);
    assert(!update.fallback->pending); // it was pushed earlier
    for (Update& later : m_updates)
    {
        if (later.fallback == update.entry)
        {
            later.fallback = update.fallback;
        }
    }
    const std::optional<std::size_t> gone = removeFailed(m_entries, update);
    const std::optional<std::size_t> gone_before =
        m_entries_before.empty() ? gone : removeFailed(m_entries_before, update);
    m_current -= gone && m_current >= *gone ? 1 : 0;
    m_current_before -= gone_before && m_current_before >= *gone_before ? 1 : 0;
}

// Removes a failed entry, or replaces it by its fallback. Returns the entry's index if it was removed.
std::optional<std::size_t> RootHistory::removeFailed(Entries& entries, const Update& update)
{
    const auto found = std::find(entries.begin(), entries.end(), update.entry);
    if (found == entries.end())
    {
        return std::nullopt;
    }
    if (*std::prev(found) != update.fallback)
    {
        *found = update.fallback;
        return std::nullopt;
    }
    const std::ptrdiff_t index = found - entries.begin();
    entries.erase(found);
    return index;
}

std::optional<RootEntry> RootHistory::undo()
{
    return undoCount() == 0 ? std::nullopt : std::optional(*m_entries[--m_current]);
}

std::optional<RootEntry> RootHistory::redo()
{
    return redoCount() == 0 ? std::nullopt : std::optional(*m_entries[++m_current]);
}

void RootHistory::forget()
{
    keepEntries();
    m_entries.resize(1);
    m_current = 0;
}

void RootHistory::frameDone(std::uint64_t frame)
{
    assert(frame <= m_frame);
    m_frame_done = std::max(m_frame_done, frame);
    for (; !m_waiting.empty() && m_waiting.front().frame <= m_frame_done; m_waiting.pop_front())
    {
        m_arena.release(m_waiting.front().region);
    }
}

std::uint64_t RootHistory::entryBytes() const
{
    std::uint64_t bytes = 0;
    for (const auto& entry : m_entries)
    {
        bytes += entry->region ? m_arena.bytes(*entry->region) : 0;
    }
    return bytes;
}

std::uint64_t RootHistory::waitingBytes() const
{
    return m_arena.heldBytes() - arenaLater().heldBytes();
}

bool RootHistory::dropEntry()
{
    if (redoCount() != 0)
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

} // namespace zvo
