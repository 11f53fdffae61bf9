// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/error.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace zvo
{

/// What to do about a file that breaks the rules of its format.
inline constexpr std::string_view kExportAgain = "the file is damaged or was written wrongly, export it again";

/// What to do about a file that ends too early.
inline constexpr std::string_view kCutShort = "the file was cut short, copy or download it again";

/// text on one line that any terminal shows: line breaks and other control characters become one space, bytes that are
/// not UTF-8 become \xNN, and the middle of a very long text is left out.
std::string toOneLine(std::string_view text);

/// Error{Input}: path and text, on one line.
Error inputError(const std::filesystem::path& path, std::string_view text);

} // namespace zvo
