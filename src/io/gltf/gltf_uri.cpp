// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_uri.h"

#include "io/file/text_cursor.h"

#include <charconv>

namespace zvo
{

namespace
{

constexpr std::string_view kDataScheme = "data:";
constexpr std::string_view kBase64Mark = ";base64";

std::optional<std::uint32_t> base64Digit(char digit)
{
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t value = kAlphabet.find(digit);
    return value == std::string_view::npos ? std::nullopt : std::optional(static_cast<std::uint32_t>(value));
}

/// Base64 (RFC 4648) with or without padding.
std::optional<std::vector<std::uint8_t>> decodeBase64(std::string_view text)
{
    while (text.ends_with('='))
    {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1)
    {
        return std::nullopt;
    }
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    std::uint32_t bit_count = 0;
    for (const char character : text)
    {
        const std::optional<std::uint32_t> digit = base64Digit(character);
        if (!digit)
        {
            return std::nullopt;
        }
        bits = (bits << 6U) | *digit;
        bit_count += 6;
        if (bit_count >= 8)
        {
            bit_count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count));
        }
    }
    return bytes;
}

} // namespace

std::string decodePercent(std::string_view text)
{
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        std::uint8_t byte = 0;
        const char* const digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2)
        {
            decoded += static_cast<char>(byte);
            i += 2;
            continue;
        }
        decoded += text[i];
    }
    return decoded;
}

bool isDataUri(std::string_view uri)
{
    return lowered(uri.substr(0, kDataScheme.size())) == kDataScheme;
}

bool isRemoteUri(std::string_view uri)
{
    const std::size_t scheme = uri.find("://");
    return scheme != std::string_view::npos && uri.substr(0, scheme).find('/') == std::string_view::npos;
}

std::optional<std::vector<std::uint8_t>> decodeDataUri(std::string_view uri)
{
    const std::size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos)
    {
        return std::nullopt;
    }
    const std::string_view data = uri.substr(comma + 1);
    if (uri.substr(0, comma).ends_with(kBase64Mark))
    {
        return decodeBase64(data);
    }
    const std::string decoded = decodePercent(data);
    return std::vector<std::uint8_t>(decoded.begin(), decoded.end());
}

} // namespace zvo
