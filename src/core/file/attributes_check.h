// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <optional>
#include <string>

namespace zvo
{

/// What is wrong with the attributes, in whichever format, and the emission of tree, in one line; nothing where they
/// are sound: as many as its counts of voxels and octree nodes ask for, with codes and flags that mean something, and
/// emission for those voxels that say so. For checkTree(), which has found those counts to be true.
std::optional<std::string> checkAttributes(const TreeData& tree);

} // namespace zvo
