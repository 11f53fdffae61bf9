// SPDX-License-Identifier: MIT
// Trees that the oracles make in the host's memory.
#pragma once

#include "core/tree/tree_data.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zvo::test
{

/// The octree of sorted, unique Morton codes, without attributes. The grid has its corner at 0 and voxels of size 1.
TreeData octreeOf(std::span<const std::uint64_t> codes, std::uint32_t depth);

/// Gives all voxels and nodes of an octree arbitrary attributes. One voxel in eight has no normal, one in seven
/// emission.
void addAttributes(TreeData& octree);

/// The same tree with its attributes in a packed form.
TreeData packedTree(const TreeData& tree, AttributeFormat format);

/// The DAG of an octree, in which equal subtrees are one.
TreeData dagOf(const TreeData& octree);

struct TreeSample
{
    std::string name;
    TreeData tree;
};

/// Octrees and DAGs, with and without attributes: empty, of one voxel, full, regular and random ones, of depths 1 to 6.
/// Some also have packed attributes, with names that end in "_with_attributes_4" or "_block".
std::vector<TreeSample> treeSamples();

/// The sample of this name.
TreeData treeSample(const std::string& name);

/// Returns the first difference of two trees, or "".
std::string treeDifference(const TreeData& actual, const TreeData& expected);

} // namespace zvo::test
