// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree/octree_build.h"
#include "core/overlay/overlay_arena.h"
#include "core/tree/device_tree.h"
#include "core/update/layer.h"
#include "update/update.h"
#include "vk/frame_graph.h"
#include "zvo/types.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// The capacities of an update's buffers. Those of its region are not included.
struct UpdateCapacities
{
    std::uint64_t touched = 0;       // entries of the table of touched nodes, a power of two
    std::uint64_t records = 0;       // sum of the leaf capacities of all layers
    std::uint64_t overlay_nodes = 0; // of the largest region
    bool carves = false;             // some layer does

    bool operator==(const UpdateCapacities&) const = default;
};

/// The buffers that an update needs while it runs. Their contents are not needed afterwards.
struct UpdateBuffers
{
    UpdateBuffers(vk::Device& device, const UpdateCapacities& capacities, const Grid& grid);

    /// Bytes of device memory that such buffers take, without a few small ones.
    static std::uint64_t bytes(const UpdateCapacities& capacities, const Grid& grid);

    vk::BufferOf<gpu::Layer> layers;            // [kLayersMax]
    vk::BufferOf<gpu::LayerLink> links;         // [capacities.records]
    vk::BufferOf<gpu::BrickEntry> bricks;       // [capacities.touched]
    vk::BufferOf<gpu::BrickCounters> counters;  // [1]
    vk::BufferOf<gpu::uint> heads;              // [capacities.touched]
    vk::BufferOf<gpu::TouchedNode> touched;     // [capacities.touched]
    vk::BufferOf<gpu::CarvedNode> carved;       // [capacities.touched], or empty if no layer carves
    vk::BufferOf<gpu::WorkItem> items;          // the touched nodes of each level, leaves first
    vk::BufferOf<gpu::LevelRange> ranges;       // [kNodeLevelsMax] the items of each level, leaves first
    vk::BufferOf<gpu::DispatchArgs> level_args; // [kNodeLevelsMax] of each level, leaves first: one thread an item
    vk::BufferOf<gpu::uint> counts;             // [capacities.overlay_nodes] children of the overlay's nodes
    vk::BufferOf<gpu::uint> partials;           // for each level, the sums of kScanBlock counts each
    vk::BufferOf<gpu::DispatchArgs> args;       // [kArgsCount]
    vk::BufferOf<gpu::OverlayState> state;      // [1]
};

/// The node of a root. The host knows it or, while it does not know yet how an update has ended, the device does, in an
/// element of UpdateJob::roots.
struct RootSlot
{
    std::uint32_t root = gpu::kNoNode; // kNoNode: the number stands in roots[slot]
    std::uint32_t slot = 0;
};

/// An update: the layers, the tree with which they are merged, and where the result goes.
struct UpdateJob
{
    DeviceTree& tree;
    std::vector<const LayerBuffers*> layers; // at most kLayersMax
    OverlayRegion region;
    std::uint32_t base_root = 0; // root of the base tree: the static root, or that of the edited tree
    MergeRule merge = MergeRule::Average;
    std::uint32_t sum_shift = 0;                // of the layers
    std::uint32_t emission_offset = 0;          // OverlayBuffers::emissionOffset()
    const vk::BufferOf<gpu::MergeView>& view;   // [1]
    const vk::BufferOf<gpu::SceneView>& tables; // [1] of sRGB codes
    std::uint32_t slot = 0;                     // the update's element of roots and results
    vk::BufferOf<gpu::uint>& roots;
    vk::BufferOf<gpu::UpdateStatus>& results; // host-visible
};

/// Adds the stages that merge layers with the base tree: all paths of the base tree to leaves that a layer has are
/// copied to the region, and merged with the layers there. Nothing is shown yet, and nothing is read back. job and
/// everything that it refers to must outlive the stages. Cost: touched nodes and their children.
void addMergeStages(const UpdateJob& job, UpdateBuffers& buffers, UpdateStages& stages);

/// Records the pass that ends a merge. nodes[0] becomes the overlay's root, or the root `last` if something had no
/// room, and roots[slot] its number. results[slot] receives the result of the update.
void showOverlay(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, const RootSlot& last);

/// Records the pass that shows an earlier root again. Cost: constant.
void showRoot(vk::FrameGraph& graph, DeviceTree& tree, const vk::BufferOf<gpu::uint>& roots, const RootSlot& root);

} // namespace zvo
