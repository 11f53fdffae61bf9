// SPDX-License-Identifier: MIT
#include "common/progress.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdio>
#include <string>
#include <unistd.h>
#include <utility>

namespace zvo::cli
{

namespace
{

const char* g_program = "zvo";
std::function<void(std::string_view)> g_listener;
TalkTo g_talk_to = TalkTo::Both;
bool g_quiet = false;
std::atomic<bool> g_bar_shown = false;
static_assert(std::atomic<bool>::is_always_lock_free); // so that a signal handler may use it

constexpr std::size_t kBarWidth = 30;
constexpr char kClearLine[] = "\r\033[K";

} // namespace

void talk(std::string_view text)
{
    clearProgressBar();
    if (g_listener)
    {
        g_listener(text);
        if (g_talk_to == TalkTo::ListenerAlone)
        {
            return;
        }
    }
    std::string line = fmt::format("{}: {}", g_program, text);
    std::replace_if(
        line.begin(), line.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, ' ');
    line += '\n';
    std::fwrite(line.data(), 1, line.size(), stderr);
}

void tellRun(std::string_view text)
{
    if (!g_quiet)
    {
        talk(text);
    }
}

void setQuiet(bool quiet)
{
    g_quiet = quiet;
}

void warnOrRefuse(const std::vector<std::string>& warnings, bool strict)
{
    if (strict && !warnings.empty())
    {
        throw Error(ErrorCode::Input, warnings.front() + "; --strict refuses that");
    }
    for (const std::string& warning : warnings)
    {
        talk("warning: " + warning);
    }
}

void talkError(const std::exception& error)
{
    talk(fmt::format("error: {}", error.what()));
}

void nameProgram(const char* name)
{
    g_program = name;
}

void listenToTalk(std::function<void(std::string_view)> listener, TalkTo to)
{
    g_listener = std::move(listener);
    g_talk_to = to;
}

void clearProgressBar() noexcept
{
    if (g_bar_shown.exchange(false))
    {
        static_cast<void>(!::write(STDERR_FILENO, kClearLine, sizeof(kClearLine) - 1));
    }
}

Progress::Progress(std::size_t operation_count) : m_operation_count(operation_count) {}

Progress::~Progress()
{
    clearProgressBar();
}

void Progress::begin(std::string_view what)
{
    m_operation = std::min(m_operation + 1, m_operation_count);
    m_what = what;
    m_start = Clock::now();
    within(0);
}

void Progress::within(double done, std::string_view count)
{
    m_done = std::clamp(done, 0.0, 1.0);
    draw(m_done, count.empty() ? m_what : fmt::format("{}, {}", m_what, count));
}

void Progress::goOn() const
{
    constexpr double kPatienceSeconds = 3;
    const std::chrono::duration<double> seconds = Clock::now() - m_start;
    if (seconds.count() >= kPatienceSeconds)
    {
        draw(m_done, fmt::format("{}, {:.0f} s", m_what, seconds.count()));
    }
}

void Progress::draw(double done, std::string_view what) const
{
    if (g_quiet || ::isatty(STDERR_FILENO) == 0)
    {
        return;
    }
    const double operations = static_cast<double>(m_operation - 1) + done;
    const auto filled = static_cast<std::size_t>(operations * kBarWidth / static_cast<double>(m_operation_count));
    const std::string line = fmt::format("{}[{:#<{}}{:.<{}}] {}/{} {:.48}", kClearLine, "", filled, "",
                                         kBarWidth - filled, m_operation, m_operation_count, what);
    g_bar_shown = true;
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
}

} // namespace zvo::cli
