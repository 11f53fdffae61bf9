// SPDX-License-Identifier: MIT
// The ends of the programs that compare for a long time.
#pragma once

#include "support/device.h"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>

namespace zvo::stress
{

/// Calls compare(), which tells whether all is well, destroys the shared device, and returns the program's exit status.
template <typename Compare> int runProgram(const char* program, const Compare& compare)
{
    try
    {
        const bool is_well = compare();
        test::destroySharedDevice();
        if (test::validationMessageCount() != 0)
        {
            fmt::print("the Vulkan validation layers reported something\n");
            return EXIT_FAILURE;
        }
        return is_well ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    catch (const std::exception& error)
    {
        fmt::print(stderr, "{}: {}\n", program, error.what());
        return 2;
    }
}

} // namespace zvo::stress
