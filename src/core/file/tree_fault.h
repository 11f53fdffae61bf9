// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace zvo
{

/// Why zvo could not have made a tree or a grid, in one line. Thrown by the first check that fails, for checkTree() and
/// checkGrid() (core/file/tree_check.h).
struct TreeFault : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// Throws TreeFault where `holds` is false.
template <typename... Arguments>
void requireSound(bool holds, fmt::format_string<Arguments...> fault, Arguments&&... arguments)
{
    if (!holds)
    {
        throw TreeFault(fmt::format(fault, std::forward<Arguments>(arguments)...));
    }
}

} // namespace zvo
