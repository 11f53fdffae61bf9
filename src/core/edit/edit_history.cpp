// SPDX-License-Identifier: MIT
#include "core/edit/edit_history.h"

#include <algorithm>
#include <utility>

namespace zvo
{

EditHistory::EditHistory(std::size_t entries_max)
    : m_entries_max(std::max<std::size_t>(entries_max, 1)), m_tops(m_entries_max + 2 + kDabsPerFrameMax),
      m_dabs(m_tops.size()), m_is_unchanged(m_tops.size()), m_strokes(m_tops.size())
{
    for (std::uint32_t slot = 1; slot < m_tops.size(); ++slot)
    {
        m_free.push_back(slot);
    }
    m_tops[0].nodes = m_tops.size(); // the slots' roots
}

EditTop EditHistory::topAbove(std::uint32_t kept) const
{
    EditTop top = m_tops[slot()];
    top.nodes = std::max(top.nodes, m_tops[kept].nodes);
    top.voxels = std::max(top.voxels, m_tops[kept].voxels);
    return top;
}

void EditHistory::freeSlots(std::size_t first, std::size_t end)
{
    const auto begin = m_line.begin();
    m_free.insert(m_free.end(), begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end));
    m_line.erase(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end));
}

std::uint32_t EditHistory::push(std::uint64_t node_bound, std::uint64_t voxel_bound, std::uint32_t kept)
{
    const EditTop from = topAbove(kept);
    const EditTop top = {from.nodes + node_bound, from.voxels + voxel_bound, from.voxel_count, false};
    const Dab dab = {slot(), kept, !m_is_stroke};
    m_stroke_count += m_is_stroke ? 0 : 1;
    dropRedo();
    const std::uint32_t to = m_free.front();
    m_free.pop_front();
    m_tops[to] = top;
    m_dabs[to] = dab;
    m_is_unchanged[to] = false;
    m_strokes[to] = m_stroke_count;
    m_line.push_back(to);
    if (m_is_stroke)
    {
        freeSlots(m_current, m_current + 1);
    }
    else if (m_current == m_entries_max)
    {
        freeSlots(0, 1);
    }
    m_current = m_line.size() - 1;
    m_is_stroke = true;
    return to;
}

bool EditHistory::undo()
{
    m_is_stroke = false;
    const bool moves = undoCount() != 0;
    m_current -= moves ? 1 : 0;
    return moves;
}

bool EditHistory::redo()
{
    m_is_stroke = false;
    const bool moves = redoCount() != 0;
    m_current += moves ? 1 : 0;
    return moves;
}

bool EditHistory::dropOldest()
{
    const std::size_t count = (undoCount() + 1) / 2;
    freeSlots(0, count);
    m_current -= count;
    return count != 0;
}

void EditHistory::dropRedo()
{
    freeSlots(m_current + 1, m_line.size());
}

// A dab that changes nothing takes no nodes.
void EditHistory::learn(std::uint32_t slot, const EditTop& top)
{
    if (const std::optional<Dab> dab = std::exchange(m_dabs[slot], std::nullopt))
    {
        const EditTop& from = m_tops[dab->from];
        const EditTop& kept = m_tops[dab->kept];
        const bool is_known = from.is_exact && kept.is_exact && top.is_exact;
        const bool is_same = top.nodes == std::max(from.nodes, kept.nodes) && top.voxel_count == from.voxel_count;
        m_is_unchanged[slot] = is_known && is_same && (dab->begins_stroke || m_is_unchanged[dab->from]);
    }
    m_tops[slot] = top;
}

std::size_t EditHistory::dropUnchanged()
{
    std::size_t count = 0;
    for (std::size_t entry = m_line.size() - 1; entry > 0; --entry)
    {
        const bool is_under_way = m_is_stroke && entry == m_current;
        if (m_is_unchanged[m_line[entry]] && !is_under_way)
        {
            freeSlots(entry, entry + 1);
            m_current -= m_current >= entry ? 1 : 0;
            ++count;
        }
    }
    return count;
}

std::vector<bool> EditHistory::used() const
{
    std::vector<bool> used(m_tops.size());
    for (const std::uint32_t slot : m_line)
    {
        used[slot] = true;
    }
    return used;
}

bool EditHistory::isExact() const
{
    return std::ranges::all_of(m_line, [this](std::uint32_t slot) { return m_tops[slot].is_exact; });
}

void EditHistory::forgetTops()
{
    for (const std::uint32_t slot : m_line)
    {
        m_tops[slot].is_exact = false;
    }
    std::ranges::fill(m_dabs, std::nullopt);
}

} // namespace zvo
