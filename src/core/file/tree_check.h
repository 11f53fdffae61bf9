// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <optional>
#include <string>

namespace zvo
{

/// Says in one line why zvo could not have made this tree; nothing where the tree is sound. Kernels do not check what
/// they read, so no other tree may reach a device. On the host, every node, entry, count and flag is read once and
/// nothing is taken for granted: the children of a node lie in the next level, so that no path is endless; every node
/// is reached; counts are those that the nodes have; numbers of voxels lie within the attributes. Whether a DAG stores
/// equal nodes several times is not checked.
std::optional<std::string> checkTree(const TreeData& tree);

/// Says in the same way why zvo could not have made this grid; nothing where the grid is sound.
std::optional<std::string> checkGrid(const Grid& grid);

} // namespace zvo
