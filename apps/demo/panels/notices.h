// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>
#include <string_view>

namespace zvo::demo
{

/// Messages of the program, which are shown over the picture for a few seconds.
class Notices
{
public:
    static constexpr std::size_t kMost = 8;
    static constexpr double kSeconds = 6;

    struct Notice
    {
        std::string text;
        double seconds_left = kSeconds;
    };

    void add(std::string_view text)
    {
        m_notices.push_back({std::string(text)});
        if (m_notices.size() > kMost)
        {
            m_notices.pop_front();
        }
    }

    void advance(double seconds)
    {
        for (Notice& notice : m_notices)
        {
            notice.seconds_left -= seconds;
        }
        std::erase_if(m_notices, [](const Notice& notice) { return notice.seconds_left <= 0; });
    }

    [[nodiscard]] const std::deque<Notice>& all() const { return m_notices; }

private:
    std::deque<Notice> m_notices;
};

} // namespace zvo::demo
