// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace zvo::test
{

/// Where a file or folder is that the build knows by `path`: there, or at `packed` in the folder that ZVO_TEST_HOME
/// names, where tests run on a machine without sources and build (scripts/pack-gpu).
std::filesystem::path placeOf(std::string_view path, std::string_view packed);

} // namespace zvo::test
