// SPDX-License-Identifier: MIT
#include "support/places.h"

#include <cstdlib>

namespace zvo::test
{

std::filesystem::path placeOf(std::string_view path, std::string_view packed)
{
    const char* const home = std::getenv("ZVO_TEST_HOME");
    return home != nullptr ? std::filesystem::path(home) / packed : std::filesystem::path(path);
}

} // namespace zvo::test
