// SPDX-License-Identifier: MIT
#include "core/update/update.h"

#include "core/base/divide_up.h"
#include "core/base/lanes.h"

#include <algorithm>
#include <vector>

namespace zvo
{

namespace
{

static_assert(static_cast<gpu::uint>(MergeRule::Average) == gpu::kMergeAverage);
static_assert(static_cast<gpu::uint>(MergeRule::DynamicWins) == gpu::kMergeDynamic);
static_assert(static_cast<gpu::uint>(MergeRule::StaticWins) == gpu::kMergeStatic);

// The most touched nodes of a level, of so many in all. level 0: the root.
std::uint32_t levelCapacity(std::uint64_t touched, std::uint32_t level)
{
    const std::uint64_t cells = level < 5 ? std::uint64_t{1} << (6 * level) : UINT32_MAX;
    return static_cast<std::uint32_t>(std::min(touched, cells));
}

std::uint64_t itemCount(std::uint64_t touched, std::uint32_t level_count)
{
    std::uint64_t count = 0;
    for (std::uint32_t level = 0; level < level_count; ++level)
    {
        count += levelCapacity(touched, level);
    }
    return count;
}

std::uint32_t partialsPerLevel(const UpdateBuffers& buffers)
{
    return static_cast<std::uint32_t>(divideUp(buffers.counts.count(), gpu::kScanBlock));
}

// Layers' buffers are read through a table of addresses: every pass that does so declares them here.
gpu::ConstPtr<gpu::Layer> readLayers(vk::AnyPass& pass, const UpdateJob& job, const UpdateBuffers& buffers)
{
    for (const LayerBuffers* layer : job.layers)
    {
        pass.read(layer->counters);
        pass.read(layer->keys);
        pass.read(layer->nodes);
        pass.read(layer->sums);
        pass.read(layer->emission_words);
        pass.read(layer->emission_sums);
    }
    return pass.read(buffers.layers);
}

// Ranks in a tree below overlays, of kernels that write nodes of overlays.
template <typename Params> void readRanks(vk::AnyPass& pass, DeviceTree& tree, Params& params)
{
    readRankSource(pass, tree, params);
    if (tree.overlays.hasRanks())
    {
        params.ranks = {pass.readWrite(tree.overlays.ranks).address - tree.overlays.ranksSkipped()};
    }
}

bool carve(const UpdateJob& job)
{
    return std::ranges::any_of(job.layers, [](const LayerBuffers* layer) { return layer->carves; });
}

// Finds what is left of touched nodes where layers carve.
void carveNodes(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    vk::Pass pass = graph.addPass(
        gpu::update::Carve{.wide_keys = hasWideKeys(job.tree.grid), .entries_per_word = job.tree.entriesPerWord()});
    gpu::CarveParams params{};
    params.bricks = pass.readWrite(buffers.bricks);
    params.nodes = pass.read(job.tree.nodes);
    params.items = pass.write(buffers.items);
    params.counters = pass.readWrite(buffers.counters);
    params.state = pass.readWrite(buffers.state);
    pass.readWrite(buffers.carved);
    params.ranges = pass.readWrite(buffers.ranges);
    params.args = pass.write(buffers.level_args);
    params.brick_mask = static_cast<std::uint32_t>(buffers.bricks.count() - 1);
    params.level_count = job.tree.grid.nodeLevels();
    params.max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    params.base_root = job.base_root;
    pass.dispatch(buffers.bricks.count(), params);
}

// Records the passes that list the touched leaves and all nodes above them. Returns the number of records.
void listTouched(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    std::vector<gpu::Layer> layers;
    std::uint32_t record_count = 0;
    for (const LayerBuffers* layer : job.layers)
    {
        const auto capacity = static_cast<std::uint32_t>(layer->leafCapacity());
        layers.push_back({{layer->counters.address()},
                          {layer->keys.address()},
                          {layer->nodes.address() + layer->firstLeaf() * sizeof(gpu::Node)},
                          {layer->sums.address()},
                          {layer->emission_words.address()},
                          {layer->emission_sums.address()},
                          record_count,
                          capacity,
                          layer->kind(job.tree.grid),
                          0});
        record_count += capacity;
    }
    graph.fill(buffers.counters, 0);
    graph.fill(buffers.args, 0);
    graph.fill(buffers.bricks, 0);
    graph.fill(buffers.heads, 0);
    graph.fill(buffers.partials, 0);
    const bool carves = carve(job);
    if (carves)
    {
        graph.fill(buffers.carved, 0);
    }
    graph.update(buffers.layers, 0, layers);
    gpu::OverlayState state{};
    state.args = {buffers.args.address()};
    state.carved = {buffers.carved.address()};
    state.level_count = job.tree.grid.nodeLevels();
    state.node_capacity = job.region.node_capacity;
    state.voxel_capacity = job.region.voxel_capacity;
    state.max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    graph.update(buffers.state, 0, std::span(&state, 1));
    std::vector<gpu::LevelRange> ranges;
    std::uint32_t first_item = 0;
    for (std::uint32_t height = 0; height < state.level_count; ++height)
    {
        ranges.push_back({first_item, 0});
        first_item += levelCapacity(buffers.bricks.count(), state.level_count - 1 - height);
    }
    graph.update(buffers.ranges, 0, ranges);
    {
        vk::Pass pass = graph.addPass(gpu::update::Insert{
            .wide_keys = hasWideKeys(job.tree.grid), .carves = carves, .exposes = carves && job.tree.filled});
        pass.readWrite(buffers.carved);
        pass.dispatch(record_count, {.layers = readLayers(pass, job, buffers),
                                     .bricks = pass.readWrite(buffers.bricks),
                                     .heads = pass.readWrite(buffers.heads),
                                     .links = pass.write(buffers.links),
                                     .items = pass.write(buffers.items),
                                     .counters = pass.readWrite(buffers.counters),
                                     .state = pass.readWrite(buffers.state),
                                     .ranges = pass.readWrite(buffers.ranges),
                                     .args = pass.write(buffers.level_args),
                                     .layer_count = static_cast<std::uint32_t>(layers.size()),
                                     .record_count = record_count,
                                     .brick_mask = static_cast<std::uint32_t>(buffers.bricks.count() - 1),
                                     .level_count = state.level_count,
                                     .max_groups_x = state.max_groups_x});
    }
    if (carves)
    {
        carveNodes(graph, job, buffers);
    }
}

// Merges the roots, and writes the root's children.
void expandTop(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    DeviceTree& tree = job.tree;
    vk::Pass pass = graph.addPass(gpu::update::Top{.wide_keys = hasWideKeys(tree.grid),
                                                   .attributes = tree.node_attributes.count() != 0,
                                                   .entries_per_word = tree.entriesPerWord(),
                                                   .carves = carve(job)});
    gpu::TopParams params{};
    pass.read(buffers.carved);
    params.bricks = pass.read(buffers.bricks);
    params.items = pass.read(buffers.items);
    params.ranges = pass.read(buffers.ranges);
    params.counters = pass.read(buffers.counters);
    params.touched = pass.readWrite(buffers.touched);
    params.nodes = pass.readWrite(tree.nodes);
    params.node_attributes = pass.readWrite(tree.node_attributes);
    params.counts = pass.readWrite(buffers.counts);
    params.state = pass.readWrite(buffers.state);
    pass.write(buffers.args);
    readRanks(pass, tree, params);
    params.brick_mask = static_cast<std::uint32_t>(buffers.bricks.count() - 1);
    params.base_root = job.base_root;
    params.first_node = job.region.first_node;
    params.first_voxel = job.region.first_voxel;
    params.attribute_offset = tree.attributeOffset();
    params.static_root = tree.overlays.static_root;
    pass.dispatch(gpu::kRootGroup, params);
}

// The first element of a level's part of UpdateBuffers::partials.
std::uint32_t firstPartial(const UpdateBuffers& buffers, std::uint32_t level)
{
    return level * partialsPerLevel(buffers);
}

// Writes the nodes of a level, without the child bases of the touched ones, and sizes the next level.
void writeNodes(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, std::uint32_t level)
{
    DeviceTree& tree = job.tree;
    vk::Pass pass = graph.addPass(gpu::update::Expand{.wide_keys = hasWideKeys(tree.grid),
                                                      .attributes = tree.node_attributes.count() != 0,
                                                      .entries_per_word = tree.entriesPerWord(),
                                                      .leaves = tree.isDag() && level + 1 == tree.grid.nodeLevels(),
                                                      .carves = carve(job)});
    gpu::ExpandParams params{};
    pass.read(buffers.carved);
    params.bricks = pass.read(buffers.bricks);
    params.items = pass.read(buffers.items);
    params.ranges = pass.read(buffers.ranges);
    params.touched = pass.readWrite(buffers.touched);
    params.nodes = pass.readWrite(tree.nodes);
    params.node_attributes = pass.readWrite(tree.node_attributes);
    params.counts = pass.write(buffers.counts);
    params.partials = pass.readWrite(buffers.partials);
    params.state = pass.readWrite(buffers.state);
    pass.write(buffers.args);
    readRanks(pass, tree, params);
    params.brick_mask = static_cast<std::uint32_t>(buffers.bricks.count() - 1);
    params.level = level;
    params.first_node = job.region.first_node;
    params.first_partial = firstPartial(buffers, level);
    params.attribute_offset = tree.attributeOffset();
    params.static_root = tree.overlays.static_root;
    pass.dispatchIndirect(buffers.args, gpu::kArgsExpand, params, buffers.bricks.count());
}

// Gives the touched nodes of a level their child bases.
void assignBases(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, std::uint32_t level)
{
    vk::Pass pass = graph.addPass(gpu::update::Assign{});
    pass.dispatchIndirect(buffers.args, gpu::kArgsAssign,
                          {.nodes = pass.readWrite(job.tree.nodes),
                           .counts = pass.read(buffers.counts),
                           .partials = pass.read(buffers.partials),
                           .state = pass.read(buffers.state),
                           .level = level,
                           .first_node = job.region.first_node,
                           .first_voxel = job.region.first_voxel,
                           .first_partial = firstPartial(buffers, level)},
                          partialsPerLevel(buffers));
}

// Records update/merge or update/merge_emission.
template <typename Kernel> void addMergePass(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    const bool emits = job.tree.emission_words.count() != 0;
    vk::Pass pass = graph.addPass(
        Kernel{.merge = job.merge, .emits = emits, .ranks = job.tree.overlays.hasRanks(), .carves = carve(job)});
    gpu::MergeParams params{};
    pass.read(buffers.carved);
    params.view = pass.read(job.view);
    pass.read(job.tables);
    pass.read(job.tree.sums.sums);
    pass.read(job.tree.sums.emission_sums);
    params.items = pass.read(buffers.items);
    params.ranges = pass.read(buffers.ranges);
    params.touched = pass.read(buffers.touched);
    params.heads = pass.read(buffers.heads);
    params.links = pass.read(buffers.links);
    params.layers = readLayers(pass, job, buffers);
    params.nodes = pass.read(job.tree.nodes);
    params.leaf_groups = pass.read(job.tree.leaf_groups);
    params.ranks = {pass.read(job.tree.overlays.ranks).address - job.tree.overlays.ranksSkipped()};
    params.node_attributes = pass.read(job.tree.node_attributes);
    params.attributes = pass.readWrite(job.tree.voxel_attributes);
    params.emission_words = pass.readWrite(job.tree.emission_words);
    params.emission = pass.readWrite(job.tree.emission);
    params.state = pass.readWrite(buffers.state);
    params.sum_shift = job.sum_shift;
    params.attribute_offset = job.tree.attributeOffset();
    pass.dispatchIndirect(buffers.args, gpu::kArgsMerge, params, buffers.bricks.count());
}

// Averages the touched nodes, from the leaves up.
void averageTouched(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    const std::uint32_t lanes = lanesOn(graph.device());
    const std::uint32_t level_count = job.tree.grid.nodeLevels();
    std::uint32_t height = 0;
    for (; height + gpu::kRootLevels < level_count; ++height)
    {
        vk::Pass pass = graph.addPass(gpu::update::Average{.lanes = lanes, .local_size_x = gpu::kNodesGroup * lanes});
        pass.dispatchIndirect(
            buffers.level_args, height,
            {.scene = pass.read(job.tables),
             .items = pass.read(buffers.items),
             .ranges = pass.read(buffers.ranges),
             .touched = pass.read(buffers.touched),
             .nodes = pass.read(job.tree.nodes),
             .children = height == 0 ? pass.read(job.tree.voxel_attributes) : pass.read(job.tree.node_attributes),
             .averages = pass.readWrite(job.tree.node_attributes),
             .state = pass.read(buffers.state),
             .item_range = height,
             .children_offset = height == 0 ? 0 : job.tree.attributeOffset(),
             .attribute_offset = job.tree.attributeOffset()},
            divideUp(buffers.bricks.count(), gpu::kNodesGroup));
    }
    const bool are_leaves = height == 0;
    const std::uint32_t threads = loneGroupOn(graph.device());
    vk::Pass pass = graph.addPass(gpu::update::AverageTop{.lanes = lanes, .local_size_x = threads});
    gpu::OverlayAverageTopParams params{};
    params.scene = pass.read(job.tables);
    params.items = pass.read(buffers.items);
    params.ranges = pass.read(buffers.ranges);
    params.touched = pass.read(buffers.touched);
    params.nodes = pass.read(job.tree.nodes);
    params.averages = pass.readWrite(job.tree.node_attributes);
    params.lowest_children =
        are_leaves ? pass.read(job.tree.voxel_attributes) : gpu::ConstPtr<gpu::Attribute>{params.averages.address};
    params.state = pass.read(buffers.state);
    params.level_count = level_count;
    params.lowest_offset = are_leaves ? 0 : job.tree.attributeOffset();
    params.attribute_offset = job.tree.attributeOffset();
    pass.dispatch(threads, params);
}

void mergeAttributes(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    const bool emits = job.tree.emission_words.count() != 0;
    if (emits)
    {
        vk::Pass pass = graph.addPass(gpu::update::EmissionPlaces{});
        gpu::EmissionPlacesParams params{};
        params.words = pass.readWrite(job.tree.emission_words);
        params.first_word = job.region.first_voxel / kVoxelBlock;
        params.word_count = job.region.voxel_capacity / kVoxelBlock;
        params.first_index = job.region.first_voxel + job.emission_offset;
        pass.dispatch(params.word_count, params);
    }
    addMergePass<gpu::update::Merge>(graph, job, buffers);
    if (emits)
    {
        addMergePass<gpu::update::MergeEmission>(graph, job, buffers);
    }
    if (job.tree.node_attributes.count() != 0)
    {
        averageTouched(graph, job, buffers);
    }
}

} // namespace

void showOverlay(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, const RootSlot& last)
{
    vk::Pass pass = graph.addPass(gpu::update::Finish{.attributes = job.tree.node_attributes.count() != 0});
    pass.dispatch(1, {.nodes = pass.readWrite(job.tree.nodes),
                      .node_attributes = pass.readWrite(job.tree.node_attributes),
                      .counters = pass.read(buffers.counters),
                      .state = pass.read(buffers.state),
                      .results = pass.readWrite(job.results),
                      .roots = pass.readWrite(job.roots),
                      .root = job.region.first_node,
                      .last_root = last.root,
                      .last_slot = last.slot,
                      .slot = job.slot,
                      .sum_shift = job.sum_shift,
                      .attribute_offset = job.tree.attributeOffset()});
}

UpdateBuffers::UpdateBuffers(vk::Device& device, const UpdateCapacities& capacities, const Grid& grid)
    : layers(device, "update/layers", gpu::kLayersMax), links(device, "update/links", capacities.records),
      bricks(device, "update/bricks", capacities.touched), counters(device, "update/brick_counters", 1),
      heads(device, "update/heads", capacities.touched), touched(device, "update/touched", capacities.touched),
      carved(device, "update/carved", capacities.carves ? capacities.touched : 0),
      items(device, "update/items", itemCount(capacities.touched, grid.nodeLevels())),
      ranges(device, "update/ranges", gpu::kNodeLevelsMax),
      level_args(device, "update/level_args", gpu::kNodeLevelsMax),
      counts(device, "update/counts", capacities.overlay_nodes),
      partials(device, "update/partials", grid.nodeLevels() * divideUp(capacities.overlay_nodes, gpu::kScanBlock)),
      args(device, "update/args", gpu::kArgsCount), state(device, "update/state", 1)
{
}

std::uint64_t UpdateBuffers::bytes(const UpdateCapacities& capacities, const Grid& grid)
{
    return capacities.touched * (sizeof(gpu::BrickEntry) + sizeof(gpu::uint) + sizeof(gpu::TouchedNode) +
                                 (capacities.carves ? sizeof(gpu::CarvedNode) : 0)) +
           itemCount(capacities.touched, grid.nodeLevels()) * sizeof(gpu::WorkItem) +
           capacities.records * sizeof(gpu::LayerLink) + capacities.overlay_nodes * sizeof(gpu::uint);
}

void addMergeStages(const UpdateJob& job, UpdateBuffers& buffers, UpdateStages& stages)
{
    const std::uint64_t records = buffers.links.count();
    const auto add = [&](const char* name, const auto& record) { stages.push_back(wholeStage(name, records, record)); };
    add("list touched nodes",
        [&job, &buffers](vk::FrameGraph& graph)
        {
            listTouched(graph, job, buffers);
            expandTop(graph, job, buffers);
        });
    for (std::uint32_t level = gpu::kRootLevels; level < job.tree.grid.nodeLevels(); ++level)
    {
        add("copy and merge a level",
            [&job, &buffers, level](vk::FrameGraph& graph)
            {
                writeNodes(graph, job, buffers, level);
                assignBases(graph, job, buffers, level);
            });
    }
    if (job.tree.hasAttributes())
    {
        add("merge attributes", [&job, &buffers](vk::FrameGraph& graph) { mergeAttributes(graph, job, buffers); });
    }
}

void showRoot(vk::FrameGraph& graph, DeviceTree& tree, const vk::BufferOf<gpu::uint>& roots, const RootSlot& root)
{
    vk::Pass pass = graph.addPass(gpu::update::Show{.attributes = tree.node_attributes.count() != 0});
    pass.dispatch(1, {.nodes = pass.readWrite(tree.nodes),
                      .node_attributes = pass.readWrite(tree.node_attributes),
                      .roots = pass.read(roots),
                      .root = root.root,
                      .slot = root.slot,
                      .attribute_offset = tree.attributeOffset()});
}

} // namespace zvo
