// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/error.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace zvo
{

/// Advice for messages about a file that breaks the rules of its format.
inline constexpr std::string_view kExportAgain = "the file is damaged or was written wrongly, export it again";

/// Advice for messages about a file that ends too early.
inline constexpr std::string_view kCutShort = "the file was cut short, copy or download it again";

/// Makes text printable on one line of any terminal: line breaks and other control characters become one space, bytes
/// that are not UTF-8 become \xNN, and the middle of a very long text is left out.
std::string toOneLine(std::string_view text);

/// Makes an Error{Input} whose message is path and text on one line.
Error inputError(const std::filesystem::path& path, std::string_view text);

} // namespace zvo
