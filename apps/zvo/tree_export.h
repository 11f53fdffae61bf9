// SPDX-License-Identifier: MIT
#pragma once

#include "common/output.h"
#include "core/tree/tree_data.h"

namespace zvo::cli
{

/// The Morton codes of all voxels, ascending, as 64-bit little-endian integers, and nothing else.
void writeMorton(const TreeData& tree, Output& output);

/// A binary little-endian PLY file: the voxels' centres in world space in Morton order, and, where the tree has
/// attributes, unit normals (0 where there is none) and sRGB colours. After: G. Turk, The PLY Polygon File Format,
/// 1994.
void writePly(const TreeData& tree, Output& output);

} // namespace zvo::cli
