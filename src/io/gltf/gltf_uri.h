// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

/// text with %XX replaced by the byte XX (RFC 3986); a % that no two hexadecimal digits follow stays.
std::string decodePercent(std::string_view text);

/// Whether a URI holds its data itself (RFC 2397).
bool isDataUri(std::string_view uri);

/// Whether a URI names something else than a file relative to the document: "https://...", "file://...".
bool isRemoteUri(std::string_view uri);

/// The bytes of a data URI, base64 or percent-encoded; nothing where it is malformed.
std::optional<std::vector<std::uint8_t>> decodeDataUri(std::string_view uri);

} // namespace zvo
