// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>

namespace zvo::test
{

/// An X server of its own, without a screen that anyone sees, on a display that no other one has.
class Xvfb
{
public:
    /// Starts one. display() is empty where Xvfb is not installed or does not start.
    Xvfb();
    ~Xvfb();
    Xvfb(const Xvfb&) = delete;
    Xvfb& operator=(const Xvfb&) = delete;

    /// For the environment variable DISPLAY.
    [[nodiscard]] const std::string& display() const { return m_display; }

private:
    pid_t m_pid = -1;
    std::string m_display;
};

} // namespace zvo::test
