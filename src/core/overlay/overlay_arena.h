// SPDX-License-Identifier: MIT
#pragma once

#include "shared/octree.h"
#include "vk/free_ranges.h"

#include <cstdint>
#include <optional>

namespace zvo
{

/// Voxels share words of the emission table by this many; what an overlay has starts at a multiple of it.
inline constexpr std::uint32_t kVoxelBlock = gpu::kVoxelsPerEmissionWord;

/// A part of the octree's buffers that one overlay may write: nodes and node attributes from first_node on, voxel
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
    std::uint32_t voxel_capacity = 0;    // of the whole buffers, at least static_voxels; a last part of a block is left
    std::uint32_t node_bytes = 0;        // of all buffers together, for each node
    std::uint32_t voxel_block_bytes = 0; // of all buffers together, for each block of kVoxelBlock voxels
};

/// Hands out the room for overlays in buffers whose lower part is a static octree or DAG. Knows only numbers: it
/// neither allocates nor frees device memory, and it does not know who is still using a region (RootHistory does). A
/// copy of an arena is independent of it.
///
/// Nodes and voxels are found independently of each other, the lowest that fit. What allocate() gives never overlaps
/// the static part nor another region that is held. heldBytes() is the sum over the regions held, and after the last
/// one is released the arena is as new. Cost: the number of free ranges, at most one more than there are regions.
class OverlayArena
{
public:
    explicit OverlayArena(const OverlaySpace& space);

    /// A region for nodes and voxels; voxel_capacity is voxels rounded up to whole blocks. Both may be 0: such a part
    /// takes no room and starts at 0. Nothing, and no change, where one of the two does not fit.
    std::optional<OverlayRegion> allocate(std::uint64_t nodes, std::uint64_t voxels);

    /// Gives the tails of region back, which is held: returns what is left of it. nodes and voxels are at most its
    /// capacities.
    OverlayRegion shrink(const OverlayRegion& region, std::uint32_t nodes, std::uint32_t voxels);

    /// Gives all of region back, as allocate() or the last shrink() returned it.
    void release(const OverlayRegion& region);

    /// The buffers have been replaced by longer ones with the same contents: regions stay what they are. No capacity
    /// may be smaller than before.
    void grow(std::uint32_t node_capacity, std::uint32_t voxel_capacity);

    [[nodiscard]] std::uint64_t bytes(const OverlayRegion& region) const;
    [[nodiscard]] std::uint64_t heldBytes() const { return m_held_bytes; }

    /// The most of each that an allocate() may ask for now.
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
