// SPDX-License-Identifier: MIT
// Octrees whose nodes stand in another order than zvo's, for the question of the thesis whether another space-filling
// curve than Morton's would serve better.
#pragma once

#include "core/tree/tree_data.h"

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo::baseline
{

/// How the nodes of a level follow each other. The children of half a node stand together, by ascending cell, in any
/// order: a node does not name them one by one.
enum class NodeOrder
{
    Morton,  ///< as zvo builds them
    Hilbert, ///< the halves that they are children of follow Hilbert's curve
    Shuffled ///< those halves are shuffled, always in the same way
};

/// The place of a cell on Hilbert's curve through a grid of (1 << depth)^3 cells, depth 1 to 21 (J. Skilling,
/// Programming the Hilbert Curve, 2004).
std::uint64_t hilbertCode(const glm::uvec3& cell, std::uint32_t depth);

/// The same octree in another order. On a device its voxels are numbered in the order of the leaves, so hits have other
/// indices. tree: an octree as zvo builds it, without attributes of inner nodes, which have the order of nodes. Throws
/// Error{Usage} for others. Cost: nodes log(nodes).
TreeData inOrder(TreeData tree, NodeOrder order);

} // namespace zvo::baseline
