// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace zvo::cli
{

/// The folder that an environment variable names; empty if the variable is not set, or is not an absolute path.
std::filesystem::path environmentPath(const char* variable);

} // namespace zvo::cli
