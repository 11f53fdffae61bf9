// SPDX-License-Identifier: MIT
#pragma once

#include "shared/octree.h"
#include "vk/free_ranges.h"

#include <cstdint>
#include <optional>

namespace zvo
{

/// Voxels in a block: so many share a word of the emission table. The voxels of an overlay start at a multiple of it.
inline constexpr std::uint32_t kVoxelBlock = gpu::kVoxelsPerEmissionWord;

/// A range of the octree's buffers that one overlay may write: nodes and node attributes from first_node on, voxel
/// attributes and words of the emission table from first_voxel on.
struct OverlayRegion
{
    std::uint32_t first_node = 0;
    std::uint32_t node_capacity = 0;
    std::uint32_t first_voxel = 0;    // a multiple of kVoxelBlock
    std::uint32_t voxel_capacity = 0; // likewise

    bool operator==(const OverlayRegion&) const = default;
};

/// What an OverlayArena divides: buffers that begin with the static octree or DAG and end with room for overlays.
struct OverlaySpace
{
    std::uint32_t static_nodes = 0;      // never handed out
    std::uint32_t node_capacity = 0;     // of the whole buffers, at least static_nodes
    std::uint32_t static_voxels = 0;     // never handed out, up to the next multiple of kVoxelBlock
    std::uint32_t voxel_capacity = 0;    // of the whole buffers, at least static_voxels; a partial last block is unused
    std::uint32_t node_bytes = 0;        // of all buffers together, for each node
    std::uint32_t voxel_block_bytes = 0; // of all buffers together, for each block of kVoxelBlock voxels
};

/// Hands out the room for overlays in buffers whose lower part is a static octree or DAG. The arena only counts: it
/// neither allocates nor frees device memory, and does not know who is still using a region (RootHistory does). A copy
/// of an arena is independent of it.
///
/// Nodes and voxels are allocated independently of each other, first fit from the low end. A region never overlaps the
/// static part nor another region that is held. heldBytes() is the sum over the regions that are held; after the last
/// one is released the arena is as new. Cost: the number of free ranges, at most one more than there are regions.
class OverlayArena
{
public:
    explicit OverlayArena(const OverlaySpace& space);

    /// Returns a region for so many nodes and voxels; its voxel_capacity is `voxels` rounded up to whole blocks. Both
    /// may be 0: that part takes no room and starts at 0. Returns nothing, and changes nothing, where one of the two
    /// does not fit.
    std::optional<OverlayRegion> allocate(std::uint64_t nodes, std::uint64_t voxels);

    /// Gives back the end of a region that is held, so that `nodes` and `voxels` remain, which are at most its
    /// capacities. Returns the rest of the region.
    OverlayRegion shrink(const OverlayRegion& region, std::uint32_t nodes, std::uint32_t voxels);

    /// Gives back all of a region, as the last call of allocate() or shrink() returned it.
    void release(const OverlayRegion& region);

    /// Tells that the buffers have been replaced by longer ones with the same contents. Regions stay as they are.
    /// Neither capacity may be smaller than before.
    void grow(std::uint32_t node_capacity, std::uint32_t voxel_capacity);

    [[nodiscard]] std::uint64_t bytes(const OverlayRegion& region) const;
    [[nodiscard]] std::uint64_t heldBytes() const { return m_held_bytes; }

    /// The most nodes, or voxels, that allocate() can give now.
    [[nodiscard]] std::uint64_t largestFreeNodes() const { return m_free_nodes.largest(); }
    [[nodiscard]] std::uint64_t largestFreeVoxels() const { return m_free_blocks.largest() * kVoxelBlock; }

    [[nodiscard]] const OverlaySpace& space() const { return m_space; }

private:
    OverlaySpace m_space;
    vk::FreeRanges m_free_nodes;
    vk::FreeRanges m_free_blocks; // of kVoxelBlock voxels
    std::uint64_t m_held_bytes = 0;
};

} // namespace zvo
