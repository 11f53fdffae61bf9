// SPDX-License-Identifier: MIT
// A model of the history of roots (core/overlay/root_history.h) that knows nothing of regions.
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

/// The line of entries, each with what it shows; the first one shows nothing. Properties fail where calls make no
/// sense.
template <typename Shown> class HistoryLine
{
public:
    explicit HistoryLine(std::size_t entries_max) : m_entries_max(entries_max) { m_shown[0] = {}; }

    /// An entry behind the current one, in the place of those of redo. is_pending: end() is going to tell how it ended.
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

    /// In the place of an entry that failed stands the one that it followed.
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

    /// One entry falls off: the last of those of redo, or else the oldest.
    void drop()
    {
        RC_ASSERT(m_at > 1 || redoCount() != 0);
        const bool is_undone = redoCount() != 0;
        m_line.erase(is_undone ? m_line.end() - 1 : m_line.begin() + 1);
        m_at -= is_undone ? 0 : 1;
    }

    /// The line becomes what it was before a frame that is lost. Numbers are not used again.
    void takeBack(const HistoryLine& before)
    {
        const std::uint64_t last = m_last;
        *this = before;
        m_last = last;
    }

    /// By one entry back or on; false at the ends.
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
    [[nodiscard]] std::uint64_t current() const { return m_line[m_at]; }

    /// What an entry that is not pending shows: itself, or the entry that it fell back to.
    [[nodiscard]] std::uint64_t endedAs(std::uint64_t id) const
    {
        const auto found = m_fell_to.find(id);
        return found != m_fell_to.end() ? found->second : id;
    }

    [[nodiscard]] std::size_t undoCount() const { return m_at; }
    [[nodiscard]] std::size_t redoCount() const { return m_line.size() - 1 - m_at; }
    [[nodiscard]] bool isPending() const { return !m_pending.empty(); }

private:
    std::size_t m_entries_max;
    std::map<std::uint64_t, Shown> m_shown; // by entry
    std::vector<std::uint64_t> m_line = {0};
    std::size_t m_at = 0;
    std::uint64_t m_last = 0;
    std::map<std::uint64_t, std::uint64_t> m_fell_to;              // of entries that failed
    std::deque<std::pair<std::uint64_t, std::uint64_t>> m_pending; // entries, and what they fall back to
};

} // namespace zvo::test
