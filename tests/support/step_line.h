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

/// The line of steps, each with what it shows; the first one shows nothing. Properties fail where calls make no sense.
template <typename Shown> class StepLine
{
public:
    explicit StepLine(std::size_t steps_max) : m_steps_max(steps_max) { m_shown[0] = {}; }

    /// A step behind the current one, in the place of those of redo. is_pending: end() is going to tell how it ended.
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
        while (m_line.size() - 1 > m_steps_max && m_at > 1)
        {
            m_line.erase(m_line.begin() + 1);
            --m_at;
        }
    }

    /// In the place of a step that failed stands the one that it followed.
    void end(std::uint64_t id, bool failed)
    {
        RC_ASSERT(!m_pending.empty());
        const auto [step, fallback] = m_pending.front();
        m_pending.pop_front();
        RC_ASSERT(step == id);
        if (!failed)
        {
            return;
        }
        m_fell_to[step] = fallback;
        for (auto& [later, falls_to] : m_pending)
        {
            falls_to = falls_to == step ? fallback : falls_to;
        }
        const auto place = std::find(m_line.begin(), m_line.end(), step);
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

    /// One step falls off: the last of those of redo, or else the oldest.
    void drop()
    {
        RC_ASSERT(m_at > 1 || redoCount() != 0);
        const bool is_undone = redoCount() != 0;
        m_line.erase(is_undone ? m_line.end() - 1 : m_line.begin() + 1);
        m_at -= is_undone ? 0 : 1;
    }

    /// The line becomes what it was before a frame that is lost. Numbers are not used again.
    void takeBack(const StepLine& before)
    {
        const std::uint64_t last = m_last;
        *this = before;
        m_last = last;
    }

    /// By one step back or on; false at the ends.
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

    /// What a step that is not pending shows: itself, or the step that it fell back to.
    [[nodiscard]] std::uint64_t endedAs(std::uint64_t id) const
    {
        const auto found = m_fell_to.find(id);
        return found != m_fell_to.end() ? found->second : id;
    }

    [[nodiscard]] std::size_t undoCount() const { return m_at; }
    [[nodiscard]] std::size_t redoCount() const { return m_line.size() - 1 - m_at; }
    [[nodiscard]] bool isPending() const { return !m_pending.empty(); }

private:
    std::size_t m_steps_max;
    std::map<std::uint64_t, Shown> m_shown; // by step
    std::vector<std::uint64_t> m_line = {0};
    std::size_t m_at = 0;
    std::uint64_t m_last = 0;
    std::map<std::uint64_t, std::uint64_t> m_fell_to;              // of steps that failed
    std::deque<std::pair<std::uint64_t, std::uint64_t>> m_pending; // steps, and what they fall back to
};

} // namespace zvo::test
