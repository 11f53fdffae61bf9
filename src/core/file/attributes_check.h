// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <optional>
#include <string>

namespace zvo
{

/// Says in one line what is wrong with the attributes of tree, in whichever format, or with its emission; nothing where
/// they are sound. Sound means: there are as many attributes as voxels and octree nodes, their codes and flags are
/// valid, and exactly the voxels that are marked emissive have emission. For checkTree(), which has verified those
/// counts before.
std::optional<std::string> checkAttributes(const TreeData& tree);

} // namespace zvo
