// SPDX-License-Identifier: MIT
// What is told on standard error while the work goes on.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace zvo::cli
{

/// A line on standard error that begins with the program's name; control characters become spaces.
void talk(std::string_view text);

/// The program's name for talk(): "zvo" until it is told. name must outlive all talk.
void nameProgram(const char* name);

/// What is told from now on goes to listener, too; null: nowhere else.
void listenToTalk(std::function<void(std::string_view)> listener);

/// Takes the progress bar off the screen, if one is shown. Async-signal-safe.
void clearProgressBar() noexcept;

/// A progress bar on standard error, if that is a terminal. One at a time.
class Progress
{
public:
    explicit Progress(std::size_t step_count);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Tells how many steps there are in all, where that shows only on the way.
    void expect(std::size_t step_count) { m_step_count = step_count; }

    /// The next step begins; what: a few words on it.
    void step(std::string_view what);

    /// How much of the step is done: 0 to 1.
    void within(double done);

private:
    void draw(double done) const;

    std::size_t m_step_count;
    std::size_t m_step = 0; // that is going on, counted from 1
    std::string m_what;
};

} // namespace zvo::cli
