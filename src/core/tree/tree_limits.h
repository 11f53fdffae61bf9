// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace zvo
{

/// The most elements of a buffer that kernels index. Drivers may take such an index for a signed 32-bit number (SPIR-V
/// treats indices of access chains as signed; RADV relies on it). Traversals index the halves of nodes, and references
/// the words of leaves, beside a flag (shaders/shared/octree.h): hence kNodesMax.
inline constexpr std::uint64_t kIndicesMax = std::uint64_t{1} << 31;
inline constexpr std::uint64_t kNodesMax = kIndicesMax / 4;

/// Throws Error{Memory} for a tree in device memory that is too large for the indices of kernels. nodes: number of
/// nodes, to which leaf words and the words of a DAG's lists are added, two to a node. attributes: of voxels or of
/// nodes, whichever are more; 0 for a tree without attributes.
void requireIndexable(std::uint64_t nodes, std::uint64_t attributes);

/// Throws Error{Memory}: a scene makes more of something than kernels count.
[[noreturn]] void throwUncountable(const char* what);

} // namespace zvo
