// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <type_traits>
#include <vector>

namespace zvo::python
{

/// The lines that the engine tells its user while one exists, in this thread: warnings.
class Notices
{
public:
    Notices();
    ~Notices();
    Notices(const Notices&) = delete;
    Notices& operator=(const Notices&) = delete;

    /// Issues the lines as Python's warnings, of the class ZvoWarning. Throws what a filter makes an exception.
    void issue() const;

    /// From now on, what the engine tells goes to the Notices of its thread, in place of standard error.
    static void listen();

private:
    std::vector<std::string> m_lines;
};

/// Does work without Python's lock, so that other threads run, then issues its warnings. work must not touch objects of
/// Python.
template <typename Work> auto withoutLock(const Work& work)
{
    const Notices notices;
    const auto unlocked = [&]
    {
        const pybind11::gil_scoped_release release;
        return work();
    };
    if constexpr (std::is_void_v<decltype(work())>)
    {
        unlocked();
        notices.issue();
    }
    else
    {
        auto result = unlocked();
        notices.issue();
        return result;
    }
}

} // namespace zvo::python
