// SPDX-License-Identifier: MIT
#include "vk/free_ranges.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace zvo::vk
{

namespace
{

std::uint64_t alignUp(std::uint64_t value, std::uint64_t alignment)
{
    return (value + alignment - 1) / alignment * alignment;
}

} // namespace

std::optional<std::uint64_t> FreeRanges::take(std::uint64_t size, std::uint64_t alignment)
{
    assert(size != 0 && alignment != 0);
    for (auto range = m_ranges.begin(); range != m_ranges.end(); ++range)
    {
        const auto [start, available] = *range;
        const std::uint64_t gap = alignUp(start, alignment) - start;
        if (gap > available || size > available - gap)
        {
            continue;
        }
        const std::uint64_t offset = start + gap;
        const std::uint64_t rest = available - gap - size;
        if (rest != 0)
        {
            m_ranges.emplace_hint(std::next(range), offset + size, rest);
        }
        if (gap != 0)
        {
            range->second = gap;
        }
        else
        {
            m_ranges.erase(range);
        }
        m_total -= size;
        return offset;
    }
    return std::nullopt;
}

void FreeRanges::give(std::uint64_t offset, std::uint64_t size)
{
    if (size == 0)
    {
        return;
    }
    m_total += size;
    auto next = m_ranges.lower_bound(offset);
    assert((next == m_ranges.end() || next->first >= offset + size) && "these are free already");
    if (next != m_ranges.end() && next->first == offset + size)
    {
        size += next->second;
        next = m_ranges.erase(next);
    }
    if (next != m_ranges.begin())
    {
        const auto previous = std::prev(next);
        assert(previous->first + previous->second <= offset && "these are free already");
        if (previous->first + previous->second == offset)
        {
            previous->second += size;
            return;
        }
    }
    m_ranges.emplace_hint(next, offset, size);
}

std::uint64_t FreeRanges::largest() const
{
    std::uint64_t most = 0;
    for (const auto& [offset, size] : m_ranges)
    {
        most = std::max(most, size);
    }
    return most;
}

} // namespace zvo::vk
