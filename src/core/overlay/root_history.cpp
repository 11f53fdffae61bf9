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
    assert(bounds.steps_max > 0);
    m_steps.push_back(std::make_shared<Step>());
}

RootHistory::~RootHistory()
{
    m_updates.clear();
    m_steps.clear();
    m_steps_before.clear();
    frameDone(m_frame);
}

// Before the line changes: what frameLost() goes back to.
void RootHistory::keepSteps()
{
    if (m_steps_before.empty() && m_frame != m_frame_done)
    {
        m_steps_before = m_steps;
    }
}

void RootHistory::frameSubmitted()
{
    m_steps_before.clear();
    m_current_before = m_current;
}

void RootHistory::frameLost()
{
    while (!m_updates.empty() && m_updates.back().frame == m_frame)
    {
        m_updates.pop_back();
    }
    if (!m_steps_before.empty())
    {
        m_steps = std::exchange(m_steps_before, {});
    }
    m_current = m_current_before;
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
        const Step* step = nullptr;
        if (end - 1 > m_current)
        {
            step = m_steps[--end].get();
        }
        else if (first < m_current)
        {
            step = m_steps[first++].get();
        }
        else
        {
            return std::nullopt;
        }
        if (step->lease)
        {
            later.release(step->lease->region);
        }
    }
    keepSteps();
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
    std::set<const Step*> seen;
    for (const auto& step : m_steps)
    {
        seen.insert(step.get());
    }
    const auto release = [&](const std::shared_ptr<Step>& step)
    {
        if (seen.insert(step.get()).second && step->lease)
        {
            later.release(step->lease->region);
        }
    };
    for (const Update& update : m_updates)
    {
        release(update.step);
        release(update.fallback);
    }
    std::ranges::for_each(m_steps_before, release);
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
    const auto step = std::make_shared<Step>();
    step->id = ++m_last_id;
    step->layers = std::move(layers);
    if (region)
    {
        step->lease.emplace(*this, *region);
        step->pending = true;
        m_updates.push_back({step, m_steps[m_current], m_frame});
    }
    keepSteps();
    m_steps.erase(m_steps.begin() + static_cast<std::ptrdiff_t>(m_current) + 1, m_steps.end());
    m_steps.push_back(step);
    ++m_current;
    while ((m_steps.size() - 1 > m_bounds.steps_max || stepBytes() > m_bounds.bytes_max) && dropStep())
    {
    }
    return m_last_id;
}

RootHistory::Update RootHistory::endUpdate([[maybe_unused]] std::uint64_t id)
{
    assert(!m_updates.empty() && m_updates.front().step->id == id && "updates end once, in the order of pushes");
    Update update = std::move(m_updates.front());
    m_updates.pop_front();
    update.step->pending = false;
    return update;
}

void RootHistory::complete(std::uint64_t id, std::uint32_t nodes, std::uint32_t voxels)
{
    const Update update = endUpdate(id);
    OverlayRegion& region = update.step->lease->region;
    region = m_arena.shrink(region, nodes, voxels);
}

void RootHistory::fail(std::uint64_t id)
{
    const Update update = endUpdate(id);
    assert(!update.fallback->pending); // it was pushed earlier
    for (Update& later : m_updates)
    {
        if (later.fallback == update.step)
        {
            later.fallback = update.fallback;
        }
    }
    const std::optional<std::size_t> gone = removeFailed(m_steps, update);
    const std::optional<std::size_t> gone_before = m_steps_before.empty() ? gone : removeFailed(m_steps_before, update);
    m_current -= gone && m_current >= *gone ? 1 : 0;
    m_current_before -= gone_before && m_current_before >= *gone_before ? 1 : 0;
}

// Returns which step is gone, if none stands in its place.
std::optional<std::size_t> RootHistory::removeFailed(Steps& steps, const Update& update)
{
    const auto place = std::find(steps.begin(), steps.end(), update.step);
    if (place == steps.end())
    {
        return std::nullopt;
    }
    if (*std::prev(place) != update.fallback)
    {
        *place = update.fallback;
        return std::nullopt;
    }
    const std::ptrdiff_t index = place - steps.begin();
    steps.erase(place);
    return index;
}

std::optional<RootStep> RootHistory::undo()
{
    return undoCount() == 0 ? std::nullopt : std::optional(describe(--m_current));
}

std::optional<RootStep> RootHistory::redo()
{
    return redoCount() == 0 ? std::nullopt : std::optional(describe(++m_current));
}

void RootHistory::forget()
{
    keepSteps();
    m_steps.resize(1);
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

std::uint64_t RootHistory::stepBytes() const
{
    std::uint64_t bytes = 0;
    for (const auto& step : m_steps)
    {
        bytes += step->lease ? m_arena.bytes(step->lease->region) : 0;
    }
    return bytes;
}

std::uint64_t RootHistory::waitingBytes() const
{
    return m_arena.heldBytes() - arenaLater().heldBytes();
}

RootStep RootHistory::describe(std::size_t index) const
{
    const Step& step = *m_steps[index];
    return {step.id, step.lease ? std::optional(step.lease->region) : std::nullopt, step.layers, step.pending};
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
