// SPDX-License-Identifier: MIT
#include "core/base/crc64.h"

#include <gtest/gtest.h>

#include <random>
#include <string_view>
#include <vector>

namespace zvo
{
namespace
{

// The definition, computed bit by bit.
std::uint64_t bitwiseCrc(std::span<const std::byte> bytes)
{
    std::uint64_t remainder = ~std::uint64_t{0};
    for (const std::byte byte : bytes)
    {
        remainder ^= static_cast<std::uint64_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
        {
            remainder = (remainder >> 1) ^ ((remainder & 1U) != 0 ? 0xc96c5795d7870f42U : 0U);
        }
    }
    return ~remainder;
}

TEST(Crc64, GivesTheCheckValueOfItsCatalogue)
{
    EXPECT_EQ(crc64(std::as_bytes(std::span(std::string_view("123456789")))), 0x995dc9bbdf1939faU);
    EXPECT_EQ(crc64({}), 0U);
}

TEST(Crc64, EqualsItsDefinitionWhateverTheSizeAndThePieces)
{
    std::mt19937 random(3);
    for (const std::size_t size : {1U, 7U, 8U, 9U, 27U, 64U, 2049U})
    {
        std::vector<std::byte> bytes(size);
        for (std::byte& byte : bytes)
        {
            byte = static_cast<std::byte>(random());
        }
        const std::uint64_t expected = bitwiseCrc(bytes);
        EXPECT_EQ(crc64(bytes), expected) << size;
        for (std::size_t cut = 0; cut <= std::min<std::size_t>(size, 20); ++cut)
        {
            EXPECT_EQ(crc64(std::span(bytes).subspan(cut), crc64(std::span(bytes).first(cut))), expected) << cut;
        }
    }
}

} // namespace
} // namespace zvo
