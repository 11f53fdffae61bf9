// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace zvo
{

/// All bytes of a file, or of a pipe until its end. Throws Error{Input} with the path and the system's reason.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path);

} // namespace zvo
