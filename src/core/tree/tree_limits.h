// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace zvo
{

/// Where kernels index a buffer, drivers may take the index for a signed 32-bit number (SPIR-V says so of access
/// chains; RADV does). Traversals index the halves of nodes.
inline constexpr std::uint64_t kIndicesMax = std::uint64_t{1} << 31;
inline constexpr std::uint64_t kNodesMax = kIndicesMax / 2;

/// Throws Error{Memory} for a tree in device memory of which kernels would not reach all. nodes: the words of a DAG's
/// lists included, two to a node; attributes: of voxels or of nodes, whichever are more, 0 for a tree without.
void requireIndexable(std::uint64_t nodes, std::uint64_t attributes);

} // namespace zvo
