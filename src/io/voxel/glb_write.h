// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"
#include "io/voxel/write_bytes.h"

namespace zvo
{

/// Passes the bytes of a binary glTF 2.0 file to `write`, piece by piece. The faces between voxels and empty cells
/// become one mesh: neighbouring faces of the same colour in one plane become rectangles (rows first, then equal rows
/// of neighbours) of four vertices each. Voxels' colours become vertex colours, in linear 16-bit fractions. The node's
/// translation and scale take cells to world space. Normals are those of the faces. Voxels that emit have materials of
/// their own (core/tree/lamps.h). A tree without voxels gives a file without a mesh. Throws Error{Usage} for a mesh of
/// 4 GiB and more.
void writeGlb(const TreeData& tree, const WriteBytes& write);

} // namespace zvo
