// SPDX-License-Identifier: MIT
#pragma once

#include "core/distance/distance_data.h"
#include "core/tree/tree_data.h"
#include "io/voxel/write_bytes.h"

namespace zvo
{

/// Passes the bytes of a NanoVDB file to `write`: the grid "distance", a level set of floats, not compressed. Active
/// are the cells in the band, with their distances in world units, negative inside; the background is the band's
/// width. Other cells are inactive and have the background's value, negative where they are inside as `filled` says, a
/// tree of the same grid; so do tiles, as their first cell has it. Cells are at the places that writeNvdb() gives
/// them. Throws as writeNvdb().
void writeNvdbDistances(const DistanceData& distances, const TreeData& filled, const WriteBytes& write);

} // namespace zvo
