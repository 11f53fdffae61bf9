// SPDX-License-Identifier: MIT
#include "core/base/crc64.h"

#include <array>
#include <bit>
#include <cstring>

namespace zvo
{

namespace
{

static_assert(std::endian::native == std::endian::little); // eight bytes are taken as one number

constexpr std::size_t kStepBytes = 8;
constexpr std::uint64_t kReflectedPolynomial = 0xc96c5795d7870f42U;

using Table = std::array<std::uint64_t, 256>;

// tables[n][b]: what byte b does to the remainder when n more bytes follow it.
constexpr std::array<Table, kStepBytes> makeTables()
{
    std::array<Table, kStepBytes> tables{};
    for (std::size_t byte = 0; byte < 256; ++byte)
    {
        std::uint64_t remainder = byte;
        for (int bit = 0; bit < 8; ++bit)
        {
            remainder = (remainder >> 1) ^ ((remainder & 1U) != 0 ? kReflectedPolynomial : 0);
        }
        tables[0][byte] = remainder;
    }
    for (std::size_t n = 1; n < kStepBytes; ++n)
    {
        for (std::size_t byte = 0; byte < 256; ++byte)
        {
            const std::uint64_t before = tables[n - 1][byte];
            tables[n][byte] = (before >> 8) ^ tables[0][before & 255U];
        }
    }
    return tables;
}

constexpr std::array<Table, kStepBytes> kTables = makeTables();

} // namespace

std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t crc)
{
    std::uint64_t remainder = ~crc;
    for (; bytes.size() >= kStepBytes; bytes = bytes.subspan(kStepBytes))
    {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data(), kStepBytes);
        word ^= remainder;
        remainder = 0;
        for (std::size_t i = 0; i < kStepBytes; ++i)
        {
            remainder ^= kTables[kStepBytes - 1 - i][(word >> (8 * i)) & 255U];
        }
    }
    for (const std::byte byte : bytes)
    {
        remainder = (remainder >> 8) ^ kTables[0][(remainder ^ static_cast<std::uint64_t>(byte)) & 255U];
    }
    return ~remainder;
}

} // namespace zvo
