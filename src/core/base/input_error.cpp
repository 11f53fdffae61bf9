// SPDX-License-Identifier: MIT
#include "core/base/input_error.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>

namespace zvo
{

namespace
{

constexpr std::size_t kLineStartMax = 400; // bytes of a line before and after what is left out of a long one
constexpr std::size_t kLineEndMax = 200;

std::uint8_t byteAt(std::string_view text, std::size_t index)
{
    return static_cast<std::uint8_t>(text[index]);
}

/// How many bytes the UTF-8 character at the start of text has (RFC 3629); 0 where there is none.
std::size_t characterBytes(std::string_view text)
{
    const std::uint8_t first = byteAt(text, 0);
    if (first < 0x80)
    {
        return 1;
    }
    const std::size_t size = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (size == 0 || text.size() < size)
    {
        return 0;
    }
    for (std::size_t i = 1; i < size; ++i)
    {
        // The second byte has a narrower range where the first one alone would allow overlong forms, surrogates, or
        // numbers past the last character.
        const std::uint8_t low = i > 1 ? 0x80 : first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
        const std::uint8_t high = i > 1 ? 0xBF : first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
        if (byteAt(text, i) < low || byteAt(text, i) > high)
        {
            return 0;
        }
    }
    return size;
}

/// The start of the character that the byte at index belongs to, in valid UTF-8.
std::size_t characterStart(std::string_view text, std::size_t index)
{
    while (index > 0 && byteAt(text, index) >= 0x80 && byteAt(text, index) < 0xC0)
    {
        --index;
    }
    return index;
}

/// C0 controls, delete, and the C1 controls, which some terminals obey in UTF-8 too.
bool isControl(std::string_view character)
{
    const std::uint8_t first = byteAt(character, 0);
    return first < ' ' || first == 0x7F || (first == 0xC2 && byteAt(character, 1) < 0xA0);
}

} // namespace

std::string toOneLine(std::string_view text)
{
    std::string line;
    for (std::size_t i = 0; i < text.size();)
    {
        const std::size_t size = characterBytes(text.substr(i));
        const std::string_view character = text.substr(i, std::max<std::size_t>(size, 1));
        i += character.size();
        if (size == 0)
        {
            line += fmt::format("\\x{:02x}", byteAt(character, 0));
        }
        else if (!isControl(character))
        {
            line += character;
        }
        else if (!line.ends_with(' '))
        {
            line += ' ';
        }
    }
    if (line.size() > kLineStartMax + kLineEndMax)
    {
        const std::size_t start = characterStart(line, kLineStartMax);
        const std::size_t end = characterStart(line, line.size() - kLineEndMax);
        line.replace(start, end - start, "...");
    }
    return line;
}

Error inputError(const std::filesystem::path& path, std::string_view text)
{
    return {ErrorCode::Input, toOneLine(fmt::format("{}: {}", path.string(), text))};
}

} // namespace zvo
