// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/edit/brush.h"
#include "core/overlay/overlay_arena.h"
#include "core/tree/device_tree.h"
#include "edit/edit.h"
#include "shared/scene.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <optional>

namespace zvo
{

/// What a dab can touch, and how much room its copies can take.
struct DabExtent
{
    gpu::EditBox box;
    std::uint32_t cell_count = 0;  // nodes that the box touches, of all levels
    std::uint32_t inner_count = 0; // those above the leaves
    std::uint32_t node_bound = 0;  // nodes that the dab's copies take at most
    std::uint32_t voxel_bound = 0; // voxels of the changed leaves at most, alignment included
    bool exposes = false;          // a filled tree is carved: the box has a voxel more on the sides that `grown` says
    gpu::uint grown = 0;           // bits of gpu::Brush::kind, from gpu::kBrushGrownShift on

    /// The extent of a dab. filled: voxels of the tree are inside, and have no attributes until they are laid bare.
    /// Nothing where the brush does not reach the grid. Throws Error{Usage} for a radius above kBrushRadiusMax, and for
    /// more than gpu::kDabEdgeMax voxels along an axis.
    static std::optional<DabExtent> of(const Brush& brush, const Grid& grid, bool filled = false);

    [[nodiscard]] std::uint32_t leafCount() const { return cell_count - inner_count; }
};

/// The buffers that a dab needs while it runs.
struct DabBuffers
{
    DabBuffers(vk::Device& device, std::uint32_t cell_count);

    vk::BufferOf<gpu::EditCell> cells; // [cell_count]
};

/// The region in which edits stand. Its first slot_count nodes are the roots of the slots (shaders/edit/edit.h).
struct EditSite
{
    DeviceTree& tree;
    OverlayRegion region;
    vk::BufferOf<gpu::EditState>& states; // [slot_count]
    std::uint32_t emission_offset = 0;    // added to a voxel's index gives the index of its emission, modulo 2^32

    [[nodiscard]] std::uint32_t slotCount() const { return static_cast<std::uint32_t>(states.count()); }
};

/// Records the pass that makes slot 0 the unedited static tree.
void beginEdits(vk::FrameGraph& graph, EditSite& site);

/// The slots that a dab reads and writes.
struct DabSlots
{
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t kept = 0; // a slot whose nodes and voxels are not overwritten either; may be `from`
};

/// Records a dab: slot `to` becomes slot `from` with the brush applied. tables: [1], for the tables of sRGB codes.
/// stamp: the words of the brush's stamp, empty without one. Nothing is read back. Where the region has too little
/// room, slot `to` becomes a copy of `from`, and EditState::failed is set. Cost: the cells of the brush's box, whatever
/// the size of tree and grid.
void recordDab(vk::FrameGraph& graph, EditSite& site, const Brush& brush, const DabExtent& extent,
               const DabSlots& slots, const vk::BufferOf<gpu::SceneView>& tables, const vk::BufferOf<gpu::uint>& stamp,
               DabBuffers& buffers);

/// Records what makes an octree the stamp of a dab. words: [extent.leafCount() * gpu::kStampWords].
void recordStamp(vk::FrameGraph& graph, const TreeStamp& stamp, const DabExtent& extent,
                 vk::BufferOf<gpu::uint>& words);

/// Records the copy of a box of an edited tree's voxels, without dynamic objects, to the words of a stamp. root: of the
/// edited tree. words: [extent.leafCount() * gpu::kStampWords].
void recordCopy(vk::FrameGraph& graph, const DeviceTree& tree, std::uint32_t root, const DabExtent& extent,
                vk::BufferOf<gpu::uint>& words, DabBuffers& buffers);

/// The buffers that a compaction needs while it runs.
struct CompactBuffers
{
    CompactBuffers(vk::Device& device, const OverlayRegion& region);

    /// Bytes of device memory that such buffers take.
    static std::uint64_t bytes(const OverlayRegion& region);

    vk::BufferOf<gpu::uint> marks;         // [region.node_capacity]
    vk::BufferOf<gpu::uint> numbers;       // [region.node_capacity]
    vk::BufferOf<gpu::uint> voxel_bits;    // [region.voxel_capacity / kVoxelBlock], or empty
    vk::BufferOf<gpu::uint> voxel_numbers; // likewise
    vk::BufferOf<gpu::uint> partials;      // block sums of the scans over nodes and voxels
    vk::BufferOf<gpu::uint> total;         // [1]
};

/// Records the passes that copy the nodes and voxels of the slots that are kept from site's region to the region `to`.
/// Nothing in site's region changes. kept: a flag for each slot; the other slots are undefined in the new region. `to`
/// must have enough room and must not overlap site's region. states: [slot_count], receives the states of the slots in
/// the new region. Cost: the size of site's region.
void recordCompaction(vk::FrameGraph& graph, EditSite& site, const OverlayRegion& to,
                      vk::BufferOf<gpu::EditState>& states, const std::vector<bool>& kept, CompactBuffers& buffers);

} // namespace zvo
