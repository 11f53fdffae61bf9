// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace zvo::vk
{

/// The free parts of something that is handed out in ranges: of a memory block, or of the nodes behind an octree. Only
/// numbers are managed. Allocation is first fit, which keeps ranges in use together at the low end. Neighbouring free
/// ranges are merged, so that there is at most one free range more than ranges in use. Cost: take() searches the free
/// ranges from the lowest on; give() takes logarithmic time.
class FreeRanges
{
public:
    /// Makes `size` numbers from `offset` on free. None of them may be free already; size may be 0.
    void give(std::uint64_t offset, std::uint64_t size);

    /// Takes `size` (at least 1) free numbers and returns the first: the lowest possible multiple of `alignment`. Free
    /// numbers in front of it stay free. Returns nothing where there is no such range.
    std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment = 1);

    [[nodiscard]] std::uint64_t total() const { return m_total; } // free numbers
    [[nodiscard]] std::uint64_t largest() const;                  // size of the largest free range; reads all of them
    [[nodiscard]] std::size_t rangeCount() const { return m_ranges.size(); }

private:
    std::map<std::uint64_t, std::uint64_t> m_ranges; // offset -> size, never touching each other
    std::uint64_t m_total = 0;
};

} // namespace zvo::vk
