// SPDX-License-Identifier: MIT
#include "io/file/utf16.h"
#include "core/base/read_file.h"

#include <string_view>

namespace zvo
{

namespace
{

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint32_t kHighFirst = 0xD800; // high surrogates, then as many low ones
constexpr std::uint32_t kLowFirst = 0xDC00;
constexpr std::uint32_t kSurrogates = 0x400;
constexpr std::uint32_t kSupplementary = 0x10000; // the first character that needs two surrogates
constexpr std::uint32_t kReplacement = 0xFFFD;

bool isAmong(std::uint32_t unit, std::uint32_t first)
{
    return unit >= first && unit < first + kSurrogates;
}

/// Appends a byte with the highest bits of a character, and up to three with six bits each.
void appendUtf8(std::vector<std::uint8_t>& utf8, std::uint32_t character)
{
    std::uint32_t tail = character < 0x80 ? 0 : character < 0x800 ? 1 : character < kSupplementary ? 2 : 3;
    const std::uint32_t mark = tail == 0 ? 0 : 0xFFU << (7 - tail) & 0xFFU;
    for (utf8.push_back(static_cast<std::uint8_t>(mark | character >> 6 * tail)); tail != 0;)
    {
        utf8.push_back(static_cast<std::uint8_t>(0x80U | (character >> 6 * --tail & 0x3FU)));
    }
}

std::vector<std::uint8_t> decodeUtf16(Bytes text, bool is_big_endian)
{
    const std::size_t unit_count = text.size() / 2;
    const auto unitAt = [&](std::size_t index)
    {
        const std::uint32_t first = text[2 * index];
        const std::uint32_t second = text[2 * index + 1];
        return is_big_endian ? first << 8U | second : second << 8U | first;
    };
    std::vector<std::uint8_t> utf8;
    utf8.reserve(text.size());
    for (std::size_t i = 0; i < unit_count; ++i)
    {
        const std::uint32_t unit = unitAt(i);
        if (!isAmong(unit, kHighFirst) && !isAmong(unit, kLowFirst))
        {
            appendUtf8(utf8, unit);
        }
        else if (isAmong(unit, kHighFirst) && i + 1 < unit_count && isAmong(unitAt(i + 1), kLowFirst))
        {
            ++i;
            appendUtf8(utf8, kSupplementary + (unit - kHighFirst) * kSurrogates + (unitAt(i) - kLowFirst));
        }
        else
        {
            appendUtf8(utf8, kReplacement);
        }
    }
    return utf8;
}

} // namespace

std::optional<std::vector<std::uint8_t>> asUtf8(Bytes text)
{
    const std::string_view characters = asText(text);
    if (characters.starts_with("\xEF\xBB\xBF"))
    {
        return std::vector<std::uint8_t>(text.begin() + 3, text.end());
    }
    if (characters.starts_with("\xFE\xFF") || characters.starts_with("\xFF\xFE"))
    {
        return decodeUtf16(text.subspan(2), text[0] == 0xFE);
    }
    if (text.size() >= 2 && (text[0] == 0) != (text[1] == 0))
    {
        return decodeUtf16(text, text[0] == 0);
    }
    return std::nullopt;
}

} // namespace zvo
