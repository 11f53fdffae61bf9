// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

namespace zvo
{

/// The part of checkTree() (core/file/tree_check.h) that checks attributes, in whichever format, and emission. Throws
/// TreeFault unless they are sound: there are as many attributes as voxels and octree nodes, their codes and flags are
/// valid, and exactly the voxels that are marked emissive have emission. The counts of voxels and nodes must have been
/// verified before.
void requireAttributes(const TreeData& tree);

} // namespace zvo
