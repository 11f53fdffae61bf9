// SPDX-License-Identifier: MIT
#include "core/edit/edit.h"

#include "core/base/color_word.h"
#include "core/base/divide_up.h"
#include "core/base/lanes.h"
#include "core/tree/device_tree.h"
#include "core/tree/rgb9e5.h"
#include "edit/compact.h"
#include "octree/octree.h"
#include "update/update.h"

#include <algorithm>
#include <vector>

namespace zvo
{

namespace
{

// tree: which is edited. grown: sides, as DabExtent has them.
gpu::Brush gpuBrush(const Brush& brush, const DeviceTree& tree, gpu::uint grown)
{
    const VoxelBox box = brush.box();
    const auto shape = static_cast<gpu::uint>(brush.isStamp() ? BrushShape::Box : brush.shape);
    const auto action = static_cast<gpu::uint>(brush.action);
    const bool emits = tree.emission_words.count() != 0 && brush.emission != gpu::vec3(0.0F);
    return {box.lo, box.hi, shape | action << gpu::kBrushActionShift | grown << gpu::kBrushGrownShift,
            (brush.color & kColorMask) | (emits ? gpu::kAttributeEmissive << 24U : 0U),
            emits ? encodeRgb9e5(brush.emission / tree.emission_scale) : 0U};
}

gpu::Ptr<gpu::BeforeChild> ranksOf(vk::AnyPass& pass, DeviceTree& tree)
{
    return {pass.readWrite(tree.overlays.ranks).address - tree.overlays.ranksSkipped()};
}

// Finds the cells of a dab, and what it does to leaves. stamp: empty without one.
void recordFind(vk::FrameGraph& graph, const DeviceTree& tree, std::uint32_t root, const gpu::Brush& brush,
                const DabExtent& extent, const vk::BufferOf<gpu::uint>& stamp, DabBuffers& buffers)
{
    vk::Pass pass = graph.addPass(gpu::edit::Find{.entries_per_word = tree.entriesPerWord(),
                                                  .attributes = tree.hasNodeAttributes(),
                                                  .stamp = stamp.count() != 0,
                                                  .exposes = extent.exposes});
    gpu::EditFindParams params{};
    params.nodes = pass.read(tree.nodes);
    readRankSource(pass, tree, params);
    params.ranks = {pass.read(tree.overlays.ranks).address - tree.overlays.ranksSkipped()};
    params.cells = pass.write(buffers.cells);
    params.stamp = pass.read(stamp);
    params.root = root;
    params.brush = brush;
    params.box = extent.box;
    pass.dispatch(extent.cell_count, params);
}

// Everything but attributes.
void recordNodes(vk::FrameGraph& graph, EditSite& site, const gpu::Brush& brush, const DabExtent& extent,
                 const DabSlots& dab, const vk::BufferOf<gpu::uint>& stamp, DabBuffers& buffers)
{
    DeviceTree& tree = site.tree;
    const gpu::EditSlots slots = {site.region.first_node, dab.from, dab.to};
    const bool attributes = tree.hasNodeAttributes();
    const bool emits = tree.emission_words.count() != 0;
    recordFind(graph, tree, slots.region_node + slots.from, brush, extent, stamp, buffers);
    {
        const std::uint32_t threads = loneGroupOn(graph.device());
        vk::Pass pass = graph.addPass(gpu::edit::Allocate{.attributes = attributes, .local_size_x = threads});
        pass.dispatch(threads, {.cells = pass.readWrite(buffers.cells),
                                .states = pass.readWrite(site.states),
                                .cell_count = extent.cell_count,
                                .inner_count = extent.inner_count,
                                .from = slots.from,
                                .to = slots.to,
                                .kept = dab.kept,
                                .node_end = site.region.first_node + site.region.node_capacity,
                                .voxel_end = site.region.first_voxel + site.region.voxel_capacity,
                                .box = extent.box});
    }
    vk::Pass pass = graph.addPass(
        gpu::edit::Nodes{.entries_per_word = tree.entriesPerWord(), .attributes = attributes, .emits = emits});
    gpu::EditNodesParams params{};
    params.nodes = pass.readWrite(tree.nodes);
    params.node_attributes = pass.readWrite(tree.node_attributes);
    readRankSource(pass, tree, params);
    params.ranks = ranksOf(pass, tree);
    params.cells = pass.readWrite(buffers.cells);
    params.states = pass.read(site.states);
    params.emission_words = pass.readWrite(tree.emission_words);
    params.slots = slots;
    params.kept = dab.kept;
    params.static_root = tree.overlays.static_root;
    params.attribute_offset = tree.attributeOffset();
    params.emission_offset = site.emission_offset;
    params.box = extent.box;
    pass.dispatch(std::uint64_t{std::max(extent.inner_count, 1U)} * gpu::kEditGroup, params);
}

// Parameters of edit/voxels or edit/emission.
template <typename Kernel>
void recordVoxelPass(vk::FrameGraph& graph, const Kernel& kernel, EditSite& site, const gpu::Brush& brush,
                     const DabExtent& extent, std::uint32_t to, const vk::BufferOf<gpu::uint>& stamp,
                     DabBuffers& buffers)
{
    vk::Pass pass = graph.addPass(kernel);
    pass.dispatch(std::uint64_t{extent.leafCount()} * gpu::kEditGroup,
                  {.node_attributes = pass.read(site.tree.node_attributes),
                   .cells = pass.read(buffers.cells),
                   .states = pass.read(site.states),
                   .attributes = pass.readWrite(site.tree.voxel_attributes),
                   .emission_words = pass.readWrite(site.tree.emission_words),
                   .emission = pass.readWrite(site.tree.emission),
                   .stamp = pass.read(stamp),
                   .to = to,
                   .inner_count = extent.inner_count,
                   .brush = brush,
                   .box = extent.box});
}

// Averages the changed nodes, from the leaves up.
void averageChanged(vk::FrameGraph& graph, EditSite& site, const DabExtent& extent, std::uint32_t to,
                    const vk::BufferOf<gpu::SceneView>& tables, DabBuffers& buffers)
{
    const std::uint32_t lanes = lanesOn(graph.device());
    const std::uint32_t leaf_count = extent.leafCount();
    std::uint32_t level_count = extent.box.level_count;
    if (leaf_count > gpu::kFewLeaves)
    {
        --level_count;
        vk::Pass pass = graph.addPass(gpu::edit::Average{.lanes = lanes});
        pass.dispatch(std::uint64_t{leaf_count} * lanes, {.scene = pass.read(tables),
                                                          .cells = pass.read(buffers.cells),
                                                          .states = pass.read(site.states),
                                                          .voxels = pass.read(site.tree.voxel_attributes),
                                                          .averages = pass.readWrite(site.tree.node_attributes),
                                                          .inner_count = extent.inner_count,
                                                          .cell_count = extent.cell_count,
                                                          .to = to,
                                                          .attribute_offset = site.tree.attributeOffset()});
    }
    const std::uint32_t threads = loneGroupOn(graph.device());
    vk::Pass pass = graph.addPass(gpu::edit::AverageTop{.lanes = lanes, .local_size_x = threads});
    pass.dispatch(threads, {.scene = pass.read(tables),
                            .cells = pass.read(buffers.cells),
                            .states = pass.read(site.states),
                            .voxels = pass.read(site.tree.voxel_attributes),
                            .averages = pass.readWrite(site.tree.node_attributes),
                            .box = extent.box,
                            .level_count = level_count,
                            .to = to,
                            .attribute_offset = site.tree.attributeOffset()});
}

void recordAttributes(vk::FrameGraph& graph, EditSite& site, const gpu::Brush& brush, const DabExtent& extent,
                      const DabSlots& slots, const vk::BufferOf<gpu::SceneView>& tables,
                      const vk::BufferOf<gpu::uint>& stamp, DabBuffers& buffers)
{
    const bool emits = site.tree.emission_words.count() != 0;
    const bool has_stamp = stamp.count() != 0;
    recordVoxelPass(graph, gpu::edit::Voxels{.emits = emits, .stamp = has_stamp, .exposes = extent.exposes}, site,
                    brush, extent, slots.to, stamp, buffers);
    if (emits)
    {
        recordVoxelPass(graph, gpu::edit::Emission{.stamp = has_stamp}, site, brush, extent, slots.to, stamp, buffers);
    }
    averageChanged(graph, site, extent, slots.to, tables, buffers);
}

// Marks the nodes and voxels of the kept slots, level by level from their roots down.
void recordMarks(vk::FrameGraph& graph, EditSite& site, const std::vector<bool>& kept, CompactBuffers& buffers)
{
    std::vector<gpu::uint> roots(site.slotCount());
    std::ranges::transform(kept, roots.begin(), [](bool is_kept) { return is_kept ? 1U : gpu::kMarkSlot; });
    graph.fill(buffers.marks, 0);
    graph.update(buffers.marks, 0, roots);
    if (site.tree.hasNodeAttributes())
    {
        graph.fill(buffers.voxel_bits, 0);
    }
    const std::uint32_t level_count = site.tree.grid.nodeLevels();
    for (std::uint32_t level = 0; level + (site.tree.hasNodeAttributes() ? 0 : 1) < level_count; ++level)
    {
        const bool are_leaves = level + 1 == level_count;
        vk::Pass pass = graph.addPass(gpu::edit::Mark{.leaves = are_leaves});
        pass.dispatch(site.region.node_capacity, {.nodes = pass.read(site.tree.nodes),
                                                  .marks = pass.readWrite(buffers.marks),
                                                  .voxel_bits = pass.readWrite(buffers.voxel_bits),
                                                  .first_node = site.region.first_node,
                                                  .node_count = site.region.node_capacity,
                                                  .first_voxel = site.region.first_voxel,
                                                  .voxel_count = site.region.voxel_capacity,
                                                  .level = level});
    }
}

// numbers[i] becomes what is kept before the i-th element of marks.
void recordNumbers(vk::FrameGraph& graph, bool are_voxels, const vk::BufferOf<gpu::uint>& marks,
                   vk::BufferOf<gpu::uint>& numbers, CompactBuffers& buffers)
{
    const std::uint64_t count = marks.count();
    const std::uint64_t threads = divideUp(count, gpu::kScanItems);
    const auto sum = [&](const auto& kernel)
    {
        vk::Pass pass = graph.addPass(kernel);
        pass.dispatch(threads, {.marks = pass.read(marks),
                                .partials = pass.readWrite(buffers.partials),
                                .numbers = pass.write(numbers),
                                .element_count = static_cast<gpu::uint>(count)});
    };
    sum(gpu::edit::LiveSums{.voxels = are_voxels});
    {
        vk::Pass pass = graph.addPass(gpu::octree::Scan{});
        pass.dispatch(gpu::kScanGroup, {.values = pass.readWrite(buffers.partials),
                                        .total = pass.write(buffers.total),
                                        .count = static_cast<gpu::uint>(divideUp(count, gpu::kScanBlock))});
    }
    sum(gpu::edit::Renumber{.voxels = are_voxels});
}

void clearEmission(vk::FrameGraph& graph, EditSite& site, const OverlayRegion& region)
{
    vk::Pass pass = graph.addPass(gpu::update::EmissionPlaces{});
    gpu::EmissionPlacesParams params{};
    params.words = pass.write(site.tree.emission_words);
    params.first_word = region.first_voxel / kVoxelBlock;
    params.word_count = region.voxel_capacity / kVoxelBlock;
    params.first_index = region.first_voxel + site.emission_offset;
    pass.dispatch(params.word_count, params);
}

} // namespace

DabBuffers::DabBuffers(vk::Device& device, std::uint32_t cell_count) : cells(device, "edit/cells", cell_count) {}

CompactBuffers::CompactBuffers(vk::Device& device, const OverlayRegion& region)
    : marks(device, "edit/marks", region.node_capacity), numbers(device, "edit/numbers", region.node_capacity),
      voxel_bits(device, "edit/voxel_bits", region.voxel_capacity / kVoxelBlock),
      voxel_numbers(device, "edit/voxel_numbers", region.voxel_capacity / kVoxelBlock),
      partials(device, "edit/partials",
               divideUp(std::max(region.node_capacity, region.voxel_capacity / kVoxelBlock), gpu::kScanBlock)),
      total(device, "edit/total", 1)
{
}

std::uint64_t CompactBuffers::bytes(const OverlayRegion& region)
{
    return 2 * sizeof(gpu::uint) * (std::uint64_t{region.node_capacity} + region.voxel_capacity / kVoxelBlock);
}

void beginEdits(vk::FrameGraph& graph, EditSite& site)
{
    DeviceTree& tree = site.tree;
    vk::Pass pass =
        graph.addPass(gpu::edit::Begin{.attributes = tree.hasNodeAttributes(), .ranks = tree.overlays.hasRanks()});
    pass.dispatch(1, {.nodes = pass.readWrite(tree.nodes),
                      .node_attributes = pass.readWrite(tree.node_attributes),
                      .ranks = ranksOf(pass, tree),
                      .states = pass.readWrite(site.states),
                      .static_root = tree.overlays.static_root,
                      .region_node = site.region.first_node,
                      .attribute_offset = tree.attributeOffset(),
                      .node_top = site.region.first_node + site.slotCount(),
                      .voxel_top = site.region.first_voxel,
                      .voxel_count = static_cast<std::uint32_t>(tree.occupiedCount())});
}

void recordDab(vk::FrameGraph& graph, EditSite& site, const Brush& brush, const DabExtent& extent,
               const DabSlots& slots, const vk::BufferOf<gpu::SceneView>& tables, const vk::BufferOf<gpu::uint>& stamp,
               DabBuffers& buffers)
{
    const gpu::Brush dab = gpuBrush(brush, site.tree, extent.grown);
    recordNodes(graph, site, dab, extent, slots, stamp, buffers);
    if (site.tree.hasNodeAttributes())
    {
        recordAttributes(graph, site, dab, extent, slots, tables, stamp, buffers);
    }
}

void recordStamp(vk::FrameGraph& graph, const TreeStamp& stamp, const DabExtent& extent, vk::BufferOf<gpu::uint>& words)
{
    const DeviceTree& tree = *stamp.tree;
    graph.fill(words, 0);
    vk::Pass pass = graph.addPass(gpu::edit::Stamp{.node_levels = tree.grid.nodeLevels(),
                                                   .attributes = tree.hasNodeAttributes(),
                                                   .emits = tree.emission_words.count() != 0});
    pass.dispatch(std::uint64_t{extent.leafCount()} * gpu::kEditGroup,
                  {.nodes = pass.read(tree.nodes),
                   .leaf_groups = pass.read(tree.leaf_groups),
                   .node_attributes = pass.read(tree.node_attributes),
                   .attributes = pass.read(tree.voxel_attributes),
                   .emission_words = pass.read(tree.emission_words),
                   .emission = pass.read(tree.emission),
                   .stamp = pass.readWrite(words),
                   .offset = stamp.offset,
                   .box = extent.box});
}

void recordCopy(vk::FrameGraph& graph, const DeviceTree& tree, std::uint32_t root, const DabExtent& extent,
                vk::BufferOf<gpu::uint>& words, DabBuffers& buffers)
{
    const gpu::Brush everything = {gpu::ivec3(extent.box.lo), gpu::ivec3(extent.box.hi),
                                   gpu::kBrushBox | gpu::kBrushPaint << gpu::kBrushActionShift, 0, 0};
    recordFind(graph, tree, root, everything, extent, {}, buffers);
    graph.fill(words, 0);
    vk::Pass pass = graph.addPass(
        gpu::edit::Copy{.attributes = tree.hasNodeAttributes(), .emits = tree.emission_words.count() != 0});
    pass.dispatch(std::uint64_t{extent.leafCount()} * gpu::kEditGroup,
                  {.node_attributes = pass.read(tree.node_attributes),
                   .cells = pass.read(buffers.cells),
                   .attributes = pass.read(tree.voxel_attributes),
                   .emission_words = pass.read(tree.emission_words),
                   .emission = pass.read(tree.emission),
                   .stamp = pass.readWrite(words),
                   .inner_count = extent.inner_count,
                   .box = extent.box});
}

void recordCompaction(vk::FrameGraph& graph, EditSite& site, const OverlayRegion& to,
                      vk::BufferOf<gpu::EditState>& states, const std::vector<bool>& kept, CompactBuffers& buffers)
{
    const bool attributes = site.tree.hasNodeAttributes();
    const bool emits = site.tree.emission_words.count() != 0;
    recordMarks(graph, site, kept, buffers);
    recordNumbers(graph, false, buffers.marks, buffers.numbers, buffers);
    if (attributes)
    {
        recordNumbers(graph, true, buffers.voxel_bits, buffers.voxel_numbers, buffers);
    }
    if (emits)
    {
        clearEmission(graph, site, to);
    }
    const auto move = [&](const auto& kernel, std::uint64_t threads)
    {
        vk::Pass pass = graph.addPass(kernel);
        gpu::EditMoveParams params{};
        params.nodes = pass.readWrite(site.tree.nodes);
        params.node_attributes = pass.readWrite(site.tree.node_attributes);
        params.ranks = ranksOf(pass, site.tree);
        params.attributes = pass.readWrite(site.tree.voxel_attributes);
        params.emission_words = pass.readWrite(site.tree.emission_words);
        params.marks = pass.read(buffers.marks);
        params.numbers = pass.read(buffers.numbers);
        params.voxel_bits = pass.read(buffers.voxel_bits);
        params.voxel_numbers = pass.read(buffers.voxel_numbers);
        params.first_node = site.region.first_node;
        params.node_count = site.region.node_capacity;
        params.first_voxel = site.region.first_voxel;
        params.voxel_count = site.region.voxel_capacity;
        params.new_first_node = to.first_node;
        params.new_first_voxel = to.first_voxel;
        params.level_count = site.tree.grid.nodeLevels();
        params.attribute_offset = site.tree.attributeOffset();
        pass.dispatch(threads, params);
    };
    move(gpu::edit::MoveNodes{.attributes = attributes, .ranks = site.tree.overlays.hasRanks()},
         site.region.node_capacity);
    if (attributes)
    {
        move(gpu::edit::MoveVoxels{.emits = emits}, site.region.voxel_capacity);
    }
    if (emits)
    {
        vk::Pass pass = graph.addPass(gpu::edit::MoveEmission{});
        pass.dispatch(site.region.voxel_capacity, {.voxel_bits = pass.read(buffers.voxel_bits),
                                                   .voxel_numbers = pass.read(buffers.voxel_numbers),
                                                   .emission_words = pass.read(site.tree.emission_words),
                                                   .emission = pass.readWrite(site.tree.emission),
                                                   .first_voxel = site.region.first_voxel,
                                                   .voxel_count = site.region.voxel_capacity,
                                                   .new_first_voxel = to.first_voxel});
    }
    vk::Pass pass = graph.addPass(gpu::edit::MoveStates{});
    pass.dispatch(site.slotCount(), {.states = pass.read(site.states),
                                     .new_states = pass.write(states),
                                     .marks = pass.read(buffers.marks),
                                     .numbers = pass.read(buffers.numbers),
                                     .voxel_bits = pass.read(buffers.voxel_bits),
                                     .voxel_numbers = pass.read(buffers.voxel_numbers),
                                     .slot_count = site.slotCount(),
                                     .first_node = site.region.first_node,
                                     .node_count = site.region.node_capacity,
                                     .first_voxel = site.region.first_voxel,
                                     .voxel_count = attributes ? site.region.voxel_capacity : 0,
                                     .new_first_node = to.first_node,
                                     .new_first_voxel = to.first_voxel});
}

} // namespace zvo
