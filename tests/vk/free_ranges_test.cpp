// SPDX-License-Identifier: MIT
#include "vk/free_ranges.h"

#include "support/properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

namespace
{

using zvo::vk::FreeRanges;

TEST(FreeRanges, TheLowestThatFitsIsTaken)
{
    FreeRanges ranges;
    ranges.give(10, 5);
    ranges.give(20, 8);
    ranges.give(40, 100);
    EXPECT_EQ(ranges.take(6), 20u);
    EXPECT_EQ(ranges.take(5), 10u);
    EXPECT_EQ(ranges.take(3), 40u) << "two are left of the second";
    EXPECT_EQ(ranges.take(2), 26u);
    EXPECT_EQ(ranges.take(98), std::nullopt);
    EXPECT_EQ(ranges.take(97), 43u);
    EXPECT_EQ(ranges.total(), 0u);
    EXPECT_EQ(ranges.largest(), 0u);
}

TEST(FreeRanges, WhatAlignmentSkipsStaysFree)
{
    FreeRanges ranges;
    ranges.give(3, 30);
    EXPECT_EQ(ranges.take(4, 16), 16u);
    EXPECT_EQ(ranges.rangeCount(), 2u);
    EXPECT_EQ(ranges.total(), 26u);
    EXPECT_EQ(ranges.take(13), 3u);
    EXPECT_EQ(ranges.take(13), 20u);
    EXPECT_EQ(ranges.rangeCount(), 0u);
}

TEST(FreeRanges, NeighborsBecomeOneRange)
{
    FreeRanges ranges;
    ranges.give(0, 10);
    ranges.give(20, 10);
    EXPECT_EQ(ranges.rangeCount(), 2u);
    ranges.give(10, 10);
    EXPECT_EQ(ranges.rangeCount(), 1u);
    EXPECT_EQ(ranges.take(30), 0u);
}

TEST(FreeRanges, NumbersMayReachTheEndOf64Bits)
{
    FreeRanges ranges;
    ranges.give(UINT64_MAX - 9, 9);
    EXPECT_EQ(ranges.take(10), std::nullopt);
    EXPECT_EQ(ranges.take(9), UINT64_MAX - 9);
}

// The same ranges, with a bit for each number.
class Bitmap
{
public:
    explicit Bitmap(std::size_t size) : m_free(size, true) {}

    std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment)
    {
        for (std::uint64_t offset = 0; offset + size <= m_free.size(); offset += alignment)
        {
            const auto first = m_free.begin() + static_cast<std::ptrdiff_t>(offset);
            const auto end = first + static_cast<std::ptrdiff_t>(size);
            if (std::find(first, end, false) == end)
            {
                std::fill(first, end, false);
                return offset;
            }
        }
        return std::nullopt;
    }

    void give(std::uint64_t offset, std::uint64_t size)
    {
        std::fill_n(m_free.begin() + static_cast<std::ptrdiff_t>(offset), size, true);
    }

    // Lengths of all runs of free numbers.
    [[nodiscard]] std::vector<std::uint64_t> runs() const
    {
        std::vector<std::uint64_t> lengths;
        for (std::size_t i = 0; i < m_free.size(); ++i)
        {
            if (m_free[i] && (i == 0 || !m_free[i - 1]))
            {
                lengths.push_back(0);
            }
            if (m_free[i])
            {
                ++lengths.back();
            }
        }
        return lengths;
    }

private:
    std::vector<bool> m_free;
};

TEST(FreeRanges, DoWhatABitmapDoes)
{
    zvo::test::checkProperty(
        3000,
        []
        {
            const auto size = *rc::gen::inRange<std::size_t>(0, 200);
            // (take or give back; amount, or which one; alignment)
            const auto operations =
                *rc::gen::container<std::vector<std::tuple<bool, std::uint64_t, std::uint64_t>>>(rc::gen::tuple(
                    rc::gen::weightedElement<bool>({{3, true}, {2, false}}), rc::gen::inRange<std::uint64_t>(1, 60),
                    rc::gen::element<std::uint64_t>(1, 1, 2, 3, 32)));
            FreeRanges ranges;
            ranges.give(0, size);
            Bitmap bitmap(size);
            std::vector<std::pair<std::uint64_t, std::uint64_t>> held;
            for (const auto& [takes, number, alignment] : operations)
            {
                if (takes)
                {
                    const std::optional<std::uint64_t> offset = ranges.take(number, alignment);
                    RC_ASSERT(offset == bitmap.take(number, alignment));
                    if (offset)
                    {
                        held.emplace_back(*offset, number);
                    }
                }
                else if (!held.empty())
                {
                    // Gives back the whole range, or its tail.
                    auto& [offset, length] = held[number % held.size()];
                    const std::uint64_t kept = number % 3 == 0 ? length / 2 : 0;
                    ranges.give(offset + kept, length - kept);
                    bitmap.give(offset + kept, length - kept);
                    length = kept;
                    std::erase_if(held, [](const auto& range) { return range.second == 0; });
                }
                const std::vector<std::uint64_t> runs = bitmap.runs();
                std::uint64_t total = 0;
                for (const std::uint64_t run : runs)
                {
                    total += run;
                }
                RC_ASSERT(ranges.rangeCount() == runs.size());
                RC_ASSERT(ranges.total() == total);
                RC_ASSERT(ranges.largest() == (runs.empty() ? 0 : *std::max_element(runs.begin(), runs.end())));
            }
        });
}

} // namespace
