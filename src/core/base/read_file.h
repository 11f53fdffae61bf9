// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace zvo
{

/// All bytes of a file, or of a pipe in /dev until its end. Throws Error{Input} with the path and the system's reason.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path);

/// count bytes of a file, from byte first on. Throws Error{Input}, also where the file has fewer.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path, std::uint64_t first, std::uint64_t count);

/// The characters of a file that is text.
inline std::string_view asText(std::span<const std::uint8_t> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace zvo
