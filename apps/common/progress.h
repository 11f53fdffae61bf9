// SPDX-License-Identifier: MIT
// Messages and progress on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::cli
{

/// Writes a line to standard error that begins with the program's name; control characters become spaces.
void talk(std::string_view text);

/// The same for how a run went, which is no warning and no error: not a word after setQuiet(true).
void tellRun(std::string_view text);

/// Whether tellRun() and progress bars stay silent from now on; at first, they do not.
void setQuiet(bool quiet);

/// Tells of warnings. strict: throws Error{Input} for the first one in place of it.
void warnOrRefuse(const std::vector<std::string>& warnings, bool strict);

/// Tells of an error that the program survives.
void talkError(const std::exception& error);

/// Sets the program's name for talk(): "zvo" until then. name must outlive all calls of talk().
void nameProgram(const char* name);

/// Who gets the lines of talk() beside a listener.
enum class TalkTo
{
    Both,         // standard error
    ListenerAlone // nobody
};

/// From now on, all lines go to listener; null: to standard error only.
void listenToTalk(std::function<void(std::string_view)> listener, TalkTo to = TalkTo::Both);

/// Removes the progress bar from the screen, if one is shown. Async-signal-safe.
void clearProgressBar() noexcept;

/// A progress bar on standard error, if that is a terminal and setQuiet() allows it. One at a time.
class Progress
{
public:
    explicit Progress(std::size_t operation_count);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Sets the number of operations in all, where it becomes known only later.
    void expect(std::size_t operation_count) { m_operation_count = operation_count; }

    /// Begins the next operation. what: a few words about it.
    void begin(std::string_view what);

    /// Sets how much of the operation is done: 0 to 1. count: the same in words, such as "3/64 samples".
    void within(double done, std::string_view count = {});

    /// Shows that an operation goes on, by its seconds once it has taken some.
    void goOn() const;

private:
    using Clock = std::chrono::steady_clock;

    void draw(double done, std::string_view what) const;

    std::size_t m_operation_count;
    std::size_t m_operation = 0; // the current operation, counted from 1
    std::string m_what;
    double m_done = 0; // of it
    Clock::time_point m_start;
};

} // namespace zvo::cli
