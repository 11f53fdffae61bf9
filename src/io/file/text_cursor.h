// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace zvo
{

/// All of word as a number, with or without a plus sign, rounded once to the type; nothing if word is not a number.
/// Independent of the locale.
template <typename T> std::optional<T> parseNumber(std::string_view word)
{
    if (word.starts_with('+'))
    {
        word.remove_prefix(1);
    }
    T value{};
    const char* const end = word.data() + word.size();
    const auto [stop, failure] = std::from_chars(word.data(), end, value);
    return failure == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

/// All of word as a number in single precision, rounded once. A number beyond single precision becomes what conversion
/// from double makes of it: 0 or infinity. What Microsoft's library has written for a number that is none ("1.#QNAN")
/// is none. Nothing if word is not a number.
inline std::optional<float> parseSingle(std::string_view word)
{
    if (const std::optional<float> value = parseNumber<float>(word))
    {
        return value;
    }
    const std::optional<double> value = parseNumber<double>(word.find(".#") == word.npos ? word : "nan");
    return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
}

/// text with the capitals of ASCII made small.
inline std::string lowered(std::string_view text)
{
    std::string small(text);
    std::transform(small.begin(), small.end(), small.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
    return small;
}

/// Reads a text line by line and word by word.
class TextCursor
{
public:
    explicit TextCursor(std::string_view text) : m_rest(text) {}

    /// The next line without its end, which is "\n", "\r\n" or "\r"; nothing at the end of the text.
    std::optional<std::string_view> line()
    {
        if (m_rest.empty())
        {
            return std::nullopt;
        }
        const std::size_t size = m_rest.find_first_of("\r\n");
        const std::string_view line = m_rest.substr(0, size);
        m_rest.remove_prefix(line.size());
        const std::size_t end = m_rest.starts_with("\r\n") ? 2 : m_rest.empty() ? 0 : 1;
        m_rest.remove_prefix(end);
        return line;
    }

    /// The next size bytes; fewer where the text ends before.
    std::string_view take(std::size_t size)
    {
        const std::string_view taken = m_rest.substr(0, size);
        m_rest.remove_prefix(taken.size());
        return taken;
    }

    /// The next word, whatever line it is on; empty at the end of the text.
    std::string_view word()
    {
        m_rest.remove_prefix(std::min(m_rest.size(), m_rest.find_first_not_of(kSpace)));
        const std::string_view word = m_rest.substr(0, m_rest.find_first_of(kSpace));
        m_rest.remove_prefix(word.size());
        return word;
    }

    /// Everything behind, without the space around it.
    std::string_view rest()
    {
        m_rest.remove_prefix(std::min(m_rest.size(), m_rest.find_first_not_of(kSpace)));
        return m_rest.substr(0, m_rest.find_last_not_of(kSpace) + 1);
    }

private:
    static constexpr std::string_view kSpace = " \t\r\n\v\f";
    std::string_view m_rest;
};

} // namespace zvo
