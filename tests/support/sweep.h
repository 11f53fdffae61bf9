// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

namespace zvo::test
{

/// Whether tests are to take the time that they need to show everything: ZVO_TEST_FULL=1. tests/large.txt names, with a
/// plus, the tests that ask.
inline bool isFull()
{
    const char* full = std::getenv("ZVO_TEST_FULL");
    return full != nullptr && std::string_view(full) == "1";
}

/// Chooses the calls that fail, one in each run, in tests of all failures. By default every 23rd call fails, the first
/// of which is another one in each sweep of the same test. With ZVO_TEST_FULL=1 every call fails, or every full_step-th
/// one where runs take long.
class Sweep
{
public:
    explicit Sweep(std::uint64_t step = 23, std::uint64_t full_step = 1) : m_step(test::isFull() ? full_step : step) {}

    /// Distance of two calls that fail.
    [[nodiscard]] std::uint64_t step() const { return m_step; }

    /// The first call that fails in the next sweep; less than step().
    std::uint64_t first() { return m_start++ % m_step; }

    /// Whether every call fails once.
    [[nodiscard]] bool isFull() const { return m_step == 1; }

    /// The least number of calls that fail in a sweep over count calls.
    [[nodiscard]] std::uint64_t share(std::uint64_t count) const { return count / m_step; }

private:
    std::uint64_t m_step;
    std::uint64_t m_start = 0; // of the next sweep, modulo m_step
};

/// Expects that a sweep over an octree's frames made hundreds of calls fail, and calls of every function of frames that
/// can fail. A sample needs fewer, and only some functions. failed: functions whose calls failed.
void expectFramesSwept(const std::set<std::string>& failed, std::uint64_t error_count);

} // namespace zvo::test
