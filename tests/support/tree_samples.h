// SPDX-License-Identifier: MIT
// Trees in the host's memory, made the direct way: maps instead of hash tables, recursion instead of passes.
#pragma once

#include "core/tree/tree_data.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo::test
{

/// The octree of sorted, unique Morton codes, without attributes; a grid with its corner at 0 and voxels of size 1.
TreeData octreeOf(std::span<const std::uint64_t> codes, std::uint32_t depth);

/// Gives all voxels and nodes of an octree arbitrary attributes, and one voxel in seven emission.
void addAttributes(TreeData& octree);

/// The same tree with its attributes in a packed form.
TreeData packedTree(const TreeData& tree, AttributeFormat format);

/// The same tree with equal subtrees as one.
TreeData dagOf(const TreeData& octree);

struct TreeSample
{
    std::string name;
    TreeData tree;
};

/// Octrees and DAGs, with attributes and without: of no voxel, of one, full ones, regular and random ones; depths 1
/// to 6. Some also with packed attributes, named "..._with_attributes_4" or "_block".
std::vector<TreeSample> treeSamples();

/// What tells two trees apart, or "" for none.
std::string treeDifference(const TreeData& actual, const TreeData& expected);

} // namespace zvo::test
