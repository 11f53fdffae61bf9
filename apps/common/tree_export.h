// SPDX-License-Identifier: MIT
#pragma once

#include "common/output.h"
#include "core/tree/tree_data.h"

#include <array>
#include <string>
#include <string_view>

namespace zvo::cli
{

/// Kinds of files that writeTree() writes, as their extensions say.
inline constexpr std::array<std::string_view, 6> kTreeFormats = {"ply", "vox", "morton", "glb", "nvdb", "zvo"};

/// The kind of a file by its name; empty if that is none of kTreeFormats.
std::string treeFormatOf(const std::string& path);

/// The kind of a file by a choice, or by its name where that is empty. Throws Error{Usage} if that is none.
std::string treeFormatFor(const std::string& path, const std::string& chosen);

/// Reports emission that files of a kind do not have; strict: refuses that.
void warnOfLostEmission(const TreeData& tree, std::string_view format, bool strict);

/// Writes a tree as a file of that kind, and does what warnOfLostEmission() does. Throws Error for what the kind cannot
/// hold, and Error{Output}.
void writeTree(const TreeData& tree, std::string_view format, Output& output, bool strict = false);

/// The Morton codes of all voxels, ascending, as 64-bit little-endian integers, and nothing else.
void writeMorton(const TreeData& tree, Output& output);

/// A binary little-endian PLY file: the voxels' centres in world space in Morton order, and, where the tree has
/// attributes, unit normals (0 where there is none) and sRGB colours. After: G. Turk, The PLY Polygon File Format,
/// 1994.
void writePly(const TreeData& tree, Output& output);

} // namespace zvo::cli
