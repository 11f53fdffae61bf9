// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace zvo
{

/// Text in UTF-16 of either byte order as UTF-8, without the byte order mark; a mark of UTF-8 is removed, too. Nothing
/// if the text is neither, and so stays as it is. Text without a mark counts as UTF-16 where one of its first two bytes
/// is zero. Surrogates without a partner become U+FFFD. After: Yergeau, RFC 3629; Hoffman and Yergeau, RFC 2781.
std::optional<std::vector<std::uint8_t>> asUtf8(std::span<const std::uint8_t> text);

} // namespace zvo
