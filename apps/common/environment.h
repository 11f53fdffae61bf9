// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace zvo::cli
{

/// An environment variable that is to name a folder; empty where it is not set, or not an absolute path.
std::filesystem::path environmentPath(const char* variable);

} // namespace zvo::cli
