// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <optional>
#include <string>

namespace zvo
{

/// What keeps tree from being one that zvo could have made, in one line; nothing where it is sound. Kernels check
/// nothing: no other tree may reach a device. Looks at every node, entry, count and flag, on the host, once each, and
/// trusts none of them: child numbers lead into the next level and nowhere else, so that no path is endless, and each
/// node is reached; counts are those that the nodes have; numbers of voxels lead into the attributes. What nodes of
/// equal content a DAG has is not asked.
std::optional<std::string> checkTree(const TreeData& tree);

/// Whether a grid can be one of zvo's, as above.
std::optional<std::string> checkGrid(const Grid& grid);

} // namespace zvo
