// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

namespace zvo::test
{

/// Which calls of a run fail, one after the other, in a test that looks at what becomes of each: every fifth, from
/// another one on each day and in each run of the same test, so that all come in turn. Every one where the environment
/// variable ZVO_TEST_FULL is 1. ZVO_TEST_SWEEP_START repeats a day: it stands for the number of the day modulo 5.
class Sweep
{
public:
    explicit Sweep(std::uint64_t step = 5)
    {
        const char* full = std::getenv("ZVO_TEST_FULL");
        m_step = full != nullptr && std::string_view(full) == "1" ? 1 : step;
        const char* start = std::getenv("ZVO_TEST_SWEEP_START");
        m_start = start != nullptr ? std::strtoull(start, nullptr, 10) : today();
    }

    /// From one call that fails to the next one.
    [[nodiscard]] std::uint64_t step() const { return m_step; }

    /// The first call of the next run that fails, below step().
    std::uint64_t first() { return m_start++ % m_step; }

    /// Whether every call fails once.
    [[nodiscard]] bool isFull() const { return m_step == 1; }

    /// Of count calls, how many fail in a run, at least.
    [[nodiscard]] std::uint64_t share(std::uint64_t count) const { return count / m_step; }

private:
    static std::uint64_t today()
    {
        const auto days = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
        return static_cast<std::uint64_t>(days.time_since_epoch().count());
    }

    std::uint64_t m_step;
    std::uint64_t m_start;
};

/// Expects that a sweep over the calls of an octree's frames made hundreds of them fail, and every function of frames
/// that can fail; of a sample fewer, and some functions. failed: functions that did.
void expectFramesSwept(const std::set<std::string>& failed, std::uint64_t error_count);

} // namespace zvo::test
