// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <cstddef>
#include <functional>
#include <span>

namespace zvo
{

/// Hands the bytes of a NanoVDB file (K. Museth, NanoVDB: A GPU-Friendly and Portable VDB Data Structure, 2021) to
/// write: one grid, "zvo", of Rgba8 values, not compressed. Each voxel is an active value in the place of its cell, its
/// sRGB colour with alpha 255, of a tree without attributes light grey; all else is inactive and 0. The place of a cell
/// times the voxel size, added to the centre of cell 0, is the voxel's centre in the world. Normals and emission are
/// left out. Takes about 4 KiB of memory for each block of 8^3 cells that has voxels. Throws Error{Memory} where the
/// host has too little for them, before anything is written. What cannot be caught: NanoVDB finishes nodes in threads,
/// and where the system starts only some of these, or has no memory for what they do, std::terminate ends the program.
void writeNvdb(const TreeData& tree, const std::function<void(std::span<const std::byte>)>& write);

} // namespace zvo
