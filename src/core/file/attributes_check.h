// SPDX-License-Identifier: MIT
// What checkTree() (core/file/tree_check.h) is made of.
#pragma once

#include "core/tree/tree_data.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace zvo
{

/// Why zvo could not have made a tree or a grid, in one line. Thrown by the first check that fails, for checkTree() and
/// checkGrid().
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

/// Throws TreeFault unless the attributes of tree, in whichever format, and its emission are sound: there are as many
/// attributes as voxels and octree nodes, their codes and flags are valid, and exactly the voxels that are marked
/// emissive have emission. The counts of voxels and nodes must have been verified before.
void requireAttributes(const TreeData& tree);

} // namespace zvo
