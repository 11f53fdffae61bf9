// SPDX-License-Identifier: MIT
#include "common/environment.h"

#include <cstdlib>

namespace zvo::cli
{

std::filesystem::path environmentPath(const char* variable)
{
    const char* value = std::getenv(variable);
    const std::filesystem::path path = value != nullptr ? value : "";
    return path.is_absolute() ? path : std::filesystem::path();
}

} // namespace zvo::cli
