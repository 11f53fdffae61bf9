// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"
#include "io/voxel/write_bytes.h"

namespace zvo
{

/// Passes the bytes of a NanoVDB file (K. Museth, NanoVDB: A GPU-Friendly and Portable VDB Data Structure, 2021) to
/// `write`: the grids "density", of floats, and "color", of Vec3f, not compressed: types that OpenVDB has, too. Each
/// voxel is an active value at the coordinates of its cell: 1, and its linear colour, light grey in a tree without
/// attributes. Everything else is inactive and 0. A cell's coordinates times the voxel size, added to the centre of
/// cell 0, give the voxel's centre in world space. Normals and emission are left out. Takes about 14 KiB of memory for
/// each block of 8^3 cells that has voxels. Throws Error{Memory}, before anything is written, when the host has too
/// little memory for these. One failure cannot be caught: NanoVDB finishes nodes in threads, and if the system cannot
/// start all of them, or has no memory for their work, std::terminate ends the program.
void writeNvdb(const TreeData& tree, const WriteBytes& write);

} // namespace zvo
