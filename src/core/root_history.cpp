// SPDX-License-Identifier: MIT
#include "core/root_history.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace zvo
{

RootHistory::RootHistory(OverlayArena& arena, const HistoryBounds& bounds) : m_arena(arena), m_bounds(bounds)
{
    assert(bounds.steps_max > 0);
    m_steps.push_back({0, std::make_shared<Root>()});
}

RootHistory::~RootHistory()
{
    m_updates.clear();
    m_steps.clear();
    frameDone(m_frame);
}

std::optional<OverlayRegion> RootHistory::allocate(std::uint64_t nodes, std::uint64_t voxels)
{
    if (const std::optional<OverlayRegion> region = m_arena.allocate(nodes, voxels))
    {
        return region;
    }
    // How many steps it takes is found out on a copy: none shall be dropped in vain.
    OverlayArena later = arenaLater();
    std::size_t end = m_steps.size();
    std::size_t first = 1;
    while (!later.allocate(nodes, voxels))
    {
        const OverlayRegion* freed = nullptr;
        if (end - 1 > m_current)
        {
            --end;
            freed = freedBy(end, end - 1);
        }
        else if (first < m_current)
        {
            freed = freedBy(first, first + 1);
            ++first;
        }
        else
        {
            return std::nullopt;
        }
        if (freed != nullptr)
        {
            later.release(*freed);
        }
    }
    for (std::size_t count = m_steps.size() - end + first - 1; count != 0; --count)
    {
        dropStep();
    }
    return m_arena.allocate(nodes, voxels);
}

bool RootHistory::fitsLater(std::uint64_t nodes, std::uint64_t voxels) const
{
    return arenaLater().allocate(nodes, voxels).has_value();
}

// The arena when nothing is held but what the steps show.
OverlayArena RootHistory::arenaLater() const
{
    OverlayArena later = m_arena;
    for (const Waiting& waiting : m_waiting)
    {
        later.release(waiting.region);
    }
    std::vector<const Lease*> leases;
    for (const Update& update : m_updates)
    {
        leases.push_back(update.root->lease.get());
        leases.push_back(update.fallback->lease.get());
    }
    std::sort(leases.begin(), leases.end());
    leases.erase(std::unique(leases.begin(), leases.end()), leases.end());
    std::vector<const Lease*> shown;
    for (std::size_t i = 0; i < m_steps.size(); ++i)
    {
        shown.push_back(leaseOf(i));
    }
    std::sort(shown.begin(), shown.end());
    for (const Lease* lease : leases)
    {
        if (lease != nullptr && !std::binary_search(shown.begin(), shown.end(), lease))
        {
            later.release(lease->region);
        }
    }
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
    const std::shared_ptr<Root> before = m_steps[m_current].root;
    const auto root = std::make_shared<Root>();
    root->layers = std::move(layers);
    ++m_last_id;
    if (region)
    {
        root->lease = std::make_shared<Lease>(*this, *region);
        root->pending = true;
        m_updates.push_back({m_last_id, root, before});
    }
    m_steps.erase(m_steps.begin() + static_cast<std::ptrdiff_t>(m_current) + 1, m_steps.end());
    m_steps.push_back({m_last_id, root});
    ++m_current;
    while (m_steps.size() - 1 > m_bounds.steps_max || stepBytes() > m_bounds.bytes_max)
    {
        if (!dropStep())
        {
            break;
        }
    }
    return m_last_id;
}

RootHistory::Update RootHistory::endUpdate([[maybe_unused]] std::uint64_t id)
{
    assert(!m_updates.empty() && m_updates.front().id == id && "updates end once, in the order of pushes");
    Update update = std::move(m_updates.front());
    m_updates.pop_front();
    update.root->pending = false;
    return update;
}

void RootHistory::complete(std::uint64_t id, std::uint32_t nodes, std::uint32_t voxels)
{
    const Update update = endUpdate(id);
    OverlayRegion& region = update.root->lease->region;
    region = m_arena.shrink(region, nodes, voxels);
}

void RootHistory::fail(std::uint64_t id)
{
    const Update update = endUpdate(id);
    assert(!update.fallback->pending); // it was pushed earlier
    update.root->lease = update.fallback->lease;
    update.root->layers = update.fallback->layers;
}

std::optional<RootStep> RootHistory::undo()
{
    return undoCount() == 0 ? std::nullopt : std::optional(step(--m_current));
}

std::optional<RootStep> RootHistory::redo()
{
    return redoCount() == 0 ? std::nullopt : std::optional(step(++m_current));
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

// A failed update's step stands behind the one whose region it shares: equal regions are neighbours.
std::uint64_t RootHistory::stepBytes() const
{
    std::uint64_t bytes = 0;
    for (std::size_t i = 1; i < m_steps.size(); ++i)
    {
        const OverlayRegion* region = freedBy(i, i - 1);
        bytes += region != nullptr ? m_arena.bytes(*region) : 0;
    }
    return bytes;
}

std::uint64_t RootHistory::waitingBytes() const
{
    return m_arena.heldBytes() - arenaLater().heldBytes();
}

RootStep RootHistory::step(std::size_t index) const
{
    const auto& [id, root] = m_steps[index];
    return {id, root->lease ? std::optional(root->lease->region) : std::nullopt, root->layers, root->pending};
}

// The region of a step, unless it has none or shares it with that neighbour.
const OverlayRegion* RootHistory::freedBy(std::size_t index, std::size_t neighbour) const
{
    const Lease* lease = leaseOf(index);
    return lease == nullptr || lease == leaseOf(neighbour) ? nullptr : &lease->region;
}

bool RootHistory::dropStep()
{
    if (redoCount() != 0)
    {
        m_steps.pop_back();
        return true;
    }
    if (m_current > 1)
    {
        m_steps.erase(m_steps.begin() + 1);
        --m_current;
        return true;
    }
    return false;
}

} // namespace zvo
