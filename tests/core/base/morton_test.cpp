// SPDX-License-Identifier: MIT
#include "core/base/morton.h"
#include "oracle/morton.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace zvo
{
namespace
{

TEST(Morton, XStandsInTheLowestBit)
{
    EXPECT_EQ(codeOfCell({1, 0, 0}), 1U);
    EXPECT_EQ(codeOfCell({0, 1, 0}), 2U);
    EXPECT_EQ(codeOfCell({0, 0, 1}), 4U);
    EXPECT_EQ(codeOfCell({2, 3, 1}), 0b011'110U);
    EXPECT_EQ(cellOfCode(0b011'110U), glm::uvec3(2, 3, 1));
    EXPECT_EQ(cellOfCode(0), glm::uvec3(0U));
}

TEST(Morton, EveryBitOfACoordinateHasItsPlace)
{
    for (std::uint32_t bit = 0; bit < 21; ++bit)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            glm::uvec3 cell(0U);
            cell[axis] = 1U << bit;
            const std::uint64_t code = std::uint64_t{1} << (3 * bit + static_cast<std::uint32_t>(axis));
            ASSERT_EQ(codeOfCell(cell), code);
            ASSERT_EQ(cellOfCode(code), cell);
        }
    }
}

TEST(Morton, CodesAreThoseOfTheReferenceAndComeBackAsCells)
{
    std::mt19937_64 random(1);
    for (int i = 0; i < 20000; ++i)
    {
        const std::uint64_t code = random() >> (1 + random() % 62);
        const glm::uvec3 cell = cellOfCode(code);
        ASSERT_EQ(cell, oracle::mortonDecode(code));
        ASSERT_EQ(codeOfCell(cell), code);
        ASSERT_EQ(oracle::mortonEncode(cell), code);
    }
}

} // namespace
} // namespace zvo
