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

/// What a dab can touch.
struct DabExtent
{
    gpu::EditBox box;
    std::uint32_t cell_count = 0;  // of all levels
    std::uint32_t inner_count = 0; // those that are no leaves
    std::uint32_t node_bound = 0;  // nodes that its copies take at most
    std::uint32_t voxel_bound = 0; // voxels of changed leaves, at most, and what aligns them

    /// Nothing where the brush does not reach the grid. Throws Error{Usage} for a radius above kBrushRadiusMax.
    static std::optional<DabExtent> of(const Brush& brush, const Grid& grid);
};

/// What a dab needs while it runs.
struct DabBuffers
{
    DabBuffers(vk::Device& device, std::uint32_t cell_count);

    vk::BufferOf<gpu::EditCell> cells; // [cell_count]
};

/// Where edits stand: the first slot_count nodes of region are the slots' roots (edit/edit.h).
struct EditSite
{
    DeviceTree& tree;
    OverlayRegion region;
    vk::BufferOf<gpu::EditState>& states; // [slot_count]
    std::uint32_t emission_offset = 0;    // from a voxel of the region to its emission's index, modulo 2^32

    [[nodiscard]] std::uint32_t slotCount() const { return static_cast<std::uint32_t>(states.count()); }
};

/// Records the pass that makes slot 0 the static tree, of which nothing was edited.
void beginEdits(vk::FrameGraph& graph, EditSite& site);

/// The slots of a dab.
struct DabSlots
{
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t kept = 0; // nothing is written over what it is made of; it may be from
};

/// Records a dab: slot `to` becomes slot `from` with what brush does to it. tables: [1] of sRGB codes. Cost: cells of
/// the brush's box, whatever the size of tree and grid; nothing is read back. Where the region's room does not suffice,
/// slot `to` becomes a copy of `from` and EditState::failed tells.
void recordDab(vk::FrameGraph& graph, EditSite& site, const Brush& brush, const DabExtent& extent,
               const DabSlots& slots, const vk::BufferOf<gpu::SceneView>& tables, DabBuffers& buffers);

/// What compaction needs while it runs.
struct CompactBuffers
{
    CompactBuffers(vk::Device& device, const OverlayRegion& region);

    /// Bytes of device memory that such buffers take.
    static std::uint64_t bytes(const OverlayRegion& region);

    vk::BufferOf<gpu::uint> marks;         // [region.node_capacity]
    vk::BufferOf<gpu::uint> numbers;       // [region.node_capacity]
    vk::BufferOf<gpu::uint> voxel_bits;    // [region.voxel_capacity / kVoxelBlock], or empty
    vk::BufferOf<gpu::uint> voxel_numbers; // likewise
    vk::BufferOf<gpu::uint> partials;      // for blocks of either
    vk::BufferOf<gpu::uint> total;         // [1]
};

/// Records the passes that copy what kept slots are made of from site's region to another one, in which the other
/// slots are undefined. kept: for each slot whether it is. `to` has room for it, and does not overlap site's region.
/// states: [slot_count] of the slots there. Nothing of site changes. Cost: site's region.
void recordCompaction(vk::FrameGraph& graph, EditSite& site, const OverlayRegion& to,
                      vk::BufferOf<gpu::EditState>& states, const std::vector<bool>& kept, CompactBuffers& buffers);

} // namespace zvo
