// SPDX-License-Identifier: MIT
// A model of the history of roots (core/overlay/root_history.h), without regions.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

namespace zvo::test
{

/// A line of entries and what each of them shows; the first one shows nothing. Properties fail at calls that are not
/// allowed.
template <typename Shown> class HistoryLine
{
public:
    explicit HistoryLine(std::size_t entries_max) : m_entries_max(entries_max) { m_shown[0] = {}; }

    /// Adds an entry behind the current one; entries that could be redone are dropped. is_pending: end() will report
    /// the outcome.
    void push(const Shown& shown, bool is_pending)
    {
        const std::uint64_t id = ++m_last;
        m_shown[id] = shown;
        if (is_pending)
        {
            m_pending.push_back({id, m_line[m_at]});
        }
        m_line.resize(m_at + 1);
        m_line.push_back(id);
        ++m_at;
        while (m_line.size() - 1 > m_entries_max && m_at > 1)
        {
            m_line.erase(m_line.begin() + 1);
            --m_at;
        }
    }

    /// Reports the outcome of the oldest pending entry. A failed entry is replaced by the one that it followed.
    void end(std::uint64_t id, bool failed)
    {
        RC_ASSERT(!m_pending.empty());
        const auto [entry, fallback] = m_pending.front();
        m_pending.pop_front();
        RC_ASSERT(entry == id);
        if (!failed)
        {
            return;
        }
        m_fell_to[entry] = fallback;
        for (auto& [later, falls_to] : m_pending)
        {
            falls_to = falls_to == entry ? fallback : falls_to;
        }
        const auto place = std::find(m_line.begin(), m_line.end(), entry);
        if (place == m_line.end())
        {
            return;
        }
        if (*(place - 1) != fallback)
        {
            *place = fallback;
            return;
        }
        m_at -= m_at >= static_cast<std::size_t>(place - m_line.begin()) ? 1 : 0;
        m_line.erase(place);
    }

    /// Drops one entry: the last one that can be redone or, if there is none, the oldest.
    [[nodiscard]] bool canDrop() const { return m_at > 1 || redoCount() != 0; }
    void drop()
    {
        RC_ASSERT(canDrop());
        const bool is_undone = redoCount() != 0;
        m_line.erase(is_undone ? m_line.end() - 1 : m_line.begin() + 1);
        m_at -= is_undone ? 0 : 1;
    }

    /// Restores the line as it was before a lost frame. Numbers are not used again.
    void takeBack(const HistoryLine& before)
    {
        const std::uint64_t last = m_last;
        *this = before;
        m_last = last;
    }

    /// Moves by one entry back or forward. Returns false at the ends.
    bool move(int by)
    {
        if (by < 0 ? m_at == 0 : m_at + 1 == m_line.size())
        {
            return false;
        }
        m_at += static_cast<std::size_t>(by);
        return true;
    }

    [[nodiscard]] const Shown& shown() const { return m_shown.at(m_line[m_at]); }
    [[nodiscard]] const Shown& shown(std::uint64_t id) const { return m_shown.at(id); }
    [[nodiscard]] std::uint64_t current() const { return m_line[m_at]; }
    [[nodiscard]] const std::vector<std::uint64_t>& entries() const { return m_line; }

    /// The entry that is shown in place of one that has ended: itself, or the one that it fell back to.
    [[nodiscard]] std::uint64_t endedAs(std::uint64_t id) const
    {
        const auto found = m_fell_to.find(id);
        return found != m_fell_to.end() ? found->second : id;
    }

    [[nodiscard]] std::size_t undoCount() const { return m_at; }
    [[nodiscard]] std::size_t redoCount() const { return m_line.size() - 1 - m_at; }
    /// The pending entries, and what replaces them on failure.
    [[nodiscard]] const std::deque<std::pair<std::uint64_t, std::uint64_t>>& pending() const { return m_pending; }
    [[nodiscard]] bool isPending() const { return !m_pending.empty(); }

private:
    std::size_t m_entries_max;
    std::map<std::uint64_t, Shown> m_shown; // by entry
    std::vector<std::uint64_t> m_line = {0};
    std::size_t m_at = 0;
    std::uint64_t m_last = 0;
    std::map<std::uint64_t, std::uint64_t> m_fell_to; // by failed entry
    std::deque<std::pair<std::uint64_t, std::uint64_t>> m_pending;
};

} // namespace zvo::test
