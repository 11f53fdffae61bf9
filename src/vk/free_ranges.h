// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace zvo::vk
{

/// The free parts of something that is handed out in ranges: of a memory block, of the nodes behind an octree. Knows
/// only numbers. First fit keeps what is in use together at the low end; freed neighbours become one range, so that
/// there are never more free ranges than ranges in use plus one. Costs: take() looks at the free ranges from the lowest
/// on, give() finds its place in logarithmic time.
class FreeRanges
{
public:
    /// size numbers from offset on are free now. None of them may be free already; size may be 0.
    void give(std::uint64_t offset, std::uint64_t size);

    /// The lowest offset that is a multiple of alignment and from which on size (at least 1) are free; they no longer
    /// are. What is free in front of them stays so. Nothing when there is no such offset.
    std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment = 1);

    [[nodiscard]] std::uint64_t total() const { return m_total; } // free numbers
    [[nodiscard]] std::uint64_t largest() const;                  // of the free ranges; looks at all of them
    [[nodiscard]] std::size_t rangeCount() const { return m_ranges.size(); }

private:
    std::map<std::uint64_t, std::uint64_t> m_ranges; // offset -> size, never touching each other
    std::uint64_t m_total = 0;
};

} // namespace zvo::vk
