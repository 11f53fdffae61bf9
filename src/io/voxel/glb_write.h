// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/tree_data.h"

#include <cstddef>
#include <functional>
#include <span>

namespace zvo
{

/// Hands the bytes of a binary glTF 2.0 file to write, piece by piece: the faces between voxels and empty cells as one
/// mesh, neighbouring ones of the same colour in one plane as rectangles (rows first, then equal rows of neighbours),
/// four vertices each. Voxels' colours are vertex colours, in linear 16-bit fractions; cells become world space by the
/// node's translation and scale. Normals are those of the faces, and emission is left out. Without voxels there is no
/// mesh. Throws Error{Usage} for a mesh of 4 GiB and more.
void writeGlb(const TreeData& tree, const std::function<void(std::span<const std::byte>)>& write);

} // namespace zvo
