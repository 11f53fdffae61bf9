// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace zvo
{

/// Whether files with this extension, in small letters, are text that has a point in each line.
bool isXyzExtension(std::string_view extension);

/// Reads a cloud of points: text whose lines have x y z [intensity] [red green blue] [nx ny nz]. docs/input.md says how
/// columns are told apart. Throws Error{Input}, one line with the path.
Scene readXyz(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

} // namespace zvo
