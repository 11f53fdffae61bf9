// SPDX-License-Identifier: MIT
#include "core/update/update.h"

#include "core/base/divide_up.h"

#include <vector>

namespace zvo
{

namespace
{

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
        pass.read(layer->leaves);
        pass.read(layer->sums);
        pass.read(layer->emission_words);
        pass.read(layer->emission_sums);
    }
    return pass.read(buffers.layers);
}

// Records the passes that list the touched leaves and all nodes above them. Returns the number of records.
void listTouched(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    std::vector<gpu::Layer> layers;
    std::uint32_t record_count = 0;
    for (const LayerBuffers* layer : job.layers)
    {
        const auto capacity = static_cast<std::uint32_t>(layer->leaves.count());
        layers.push_back({{layer->counters.address()},
                          {layer->keys.address()},
                          {layer->leaves.address()},
                          {layer->sums.address()},
                          {layer->emission_words.address()},
                          {layer->emission_sums.address()},
                          record_count,
                          capacity});
        record_count += capacity;
    }
    graph.fill(buffers.counters, 0);
    graph.fill(buffers.status, 0);
    graph.fill(buffers.bricks, 0);
    graph.fill(buffers.heads, 0);
    graph.fill(buffers.partials, 0);
    graph.update(buffers.layers, 0, layers);
    vk::Pass pass = graph.addPass(gpu::update::Insert{.wide_keys = hasWideKeys(job.tree.grid)});
    gpu::InsertParams params{};
    params.layers = readLayers(pass, job, buffers);
    params.bricks = pass.readWrite(buffers.bricks);
    params.heads = pass.readWrite(buffers.heads);
    params.links = pass.write(buffers.links);
    params.items = pass.write(buffers.work.items);
    params.counters = pass.readWrite(buffers.counters);
    params.status = pass.readWrite(buffers.status);
    params.layer_count = static_cast<std::uint32_t>(layers.size());
    params.record_count = record_count;
    params.brick_mask = static_cast<std::uint32_t>(buffers.bricks.count() - 1);
    pass.dispatch(record_count, params);
    listAncestors(graph, job.tree.grid, buffers.bricks, buffers.counters, buffers.work);
}

void mergeRoots(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    const bool attributes = job.tree.node_attributes.count() != 0;
    vk::Pass pass = graph.addPass(gpu::update::Root{.attributes = attributes, .ranks = job.tree.overlays.hasRanks()});
    gpu::RootParams params{};
    params.bricks = pass.read(buffers.bricks);
    params.items = pass.read(buffers.work.items);
    params.ranges = pass.read(buffers.work.ranges);
    params.counters = pass.read(buffers.counters);
    params.touched = pass.write(buffers.touched);
    params.nodes = pass.readWrite(job.tree.nodes);
    params.node_attributes = pass.readWrite(job.tree.node_attributes);
    params.ranks = {pass.readWrite(job.tree.overlays.ranks).address - job.tree.overlays.ranksSkipped()};
    params.levels = pass.write(buffers.levels);
    params.args = pass.write(buffers.args);
    params.status = pass.readWrite(buffers.status);
    params.level_count = job.tree.grid.nodeLevels();
    params.base_root = job.base_root;
    params.first_node = job.region.first_node;
    params.node_capacity = job.region.node_capacity;
    params.first_voxel = job.region.first_voxel;
    params.voxel_capacity = job.region.voxel_capacity;
    params.attribute_offset = job.tree.attributeOffset();
    pass.dispatch(1, params);
}

// The first element of a level's part of UpdateBuffers::partials.
std::uint32_t firstPartial(const UpdateBuffers& buffers, std::uint32_t level)
{
    return level * partialsPerLevel(buffers);
}

// Writes the nodes of a level, without the child bases of the touched ones.
void writeNodes(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, std::uint32_t level)
{
    DeviceTree& tree = job.tree;
    const std::uint32_t level_count = tree.grid.nodeLevels();
    vk::Pass pass = graph.addPass(gpu::update::Expand{.wide_keys = hasWideKeys(tree.grid),
                                                      .attributes = tree.node_attributes.count() != 0,
                                                      .entries_per_word = tree.entriesPerWord(),
                                                      .leaves = tree.isDag() && level + 1 == level_count});
    gpu::ExpandParams params{};
    params.bricks = pass.read(buffers.bricks);
    params.items = pass.read(buffers.work.items);
    params.ranges = pass.read(buffers.work.ranges);
    params.touched = pass.readWrite(buffers.touched);
    params.nodes = pass.readWrite(tree.nodes);
    params.node_attributes = pass.readWrite(tree.node_attributes);
    params.counts = pass.write(buffers.counts);
    params.partials = pass.readWrite(buffers.partials);
    params.levels = pass.read(buffers.levels);
    if (tree.overlays.hasRanks())
    {
        readRankSource(pass, tree, params);
        params.ranks = {pass.readWrite(tree.overlays.ranks).address - tree.overlays.ranksSkipped()};
    }
    params.brick_mask = static_cast<std::uint32_t>(buffers.bricks.count() - 1);
    params.level = level;
    params.item_range = level_count - level;
    params.first_node = job.region.first_node;
    params.first_partial = firstPartial(buffers, level);
    params.attribute_offset = tree.attributeOffset();
    params.static_root = tree.overlays.static_root;
    pass.dispatchIndirect(buffers.args, gpu::kArgsExpand, params, buffers.bricks.count());
}

// Sums up the counts of a level's children; checks whether the next level has room, and sizes its passes.
void scanCounts(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, std::uint32_t level)
{
    vk::Pass pass = graph.addPass(gpu::update::Scan{});
    gpu::OverlayScanParams params{};
    params.partials = pass.readWrite(buffers.partials);
    params.levels = pass.readWrite(buffers.levels);
    params.ranges = pass.read(buffers.work.ranges);
    params.args = pass.write(buffers.args);
    params.status = pass.readWrite(buffers.status);
    params.level = level;
    params.level_count = job.tree.grid.nodeLevels();
    params.node_capacity = job.region.node_capacity;
    params.voxel_capacity = job.region.voxel_capacity;
    params.first_partial = firstPartial(buffers, level);
    params.max_groups_x = graph.device().limits().maxComputeWorkGroupCount[0];
    pass.dispatch(gpu::kScanGroup, params);
}

// Gives the touched nodes of a level their child bases.
void assignBases(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, std::uint32_t level)
{
    vk::Pass pass = graph.addPass(gpu::update::Assign{});
    gpu::OverlayAssignParams params{};
    params.nodes = pass.readWrite(job.tree.nodes);
    params.counts = pass.read(buffers.counts);
    params.partials = pass.read(buffers.partials);
    params.levels = pass.read(buffers.levels);
    params.level = level;
    params.level_count = job.tree.grid.nodeLevels();
    params.first_node = job.region.first_node;
    params.first_voxel = job.region.first_voxel;
    params.first_partial = firstPartial(buffers, level);
    pass.dispatchIndirect(buffers.args, gpu::kArgsAssign, params, partialsPerLevel(buffers));
}

// Writes the nodes of one level (not the root) and gives the touched ones their child bases.
void expandLevel(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, std::uint32_t level)
{
    writeNodes(graph, job, buffers, level);
    scanCounts(graph, job, buffers, level);
    assignBases(graph, job, buffers, level);
}

// Parameters of update/merge or update/merge_emission.
template <typename Kernel> void addMergePass(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers)
{
    const bool emits = job.tree.emission_words.count() != 0;
    vk::Pass pass = graph.addPass(Kernel{.merge = job.merge, .emits = emits, .ranks = job.tree.overlays.hasRanks()});
    gpu::MergeParams params{};
    params.view = pass.read(job.view);
    pass.read(job.tables);
    pass.read(job.tree.sums.sums);
    pass.read(job.tree.sums.emission_sums);
    params.items = pass.read(buffers.work.items);
    params.ranges = pass.read(buffers.work.ranges);
    params.touched = pass.read(buffers.touched);
    params.heads = pass.read(buffers.heads);
    params.links = pass.read(buffers.links);
    params.layers = readLayers(pass, job, buffers);
    params.nodes = pass.read(job.tree.nodes);
    params.ranks = {pass.read(job.tree.overlays.ranks).address - job.tree.overlays.ranksSkipped()};
    params.attributes = pass.readWrite(job.tree.voxel_attributes);
    params.emission_words = pass.readWrite(job.tree.emission_words);
    params.emission = pass.readWrite(job.tree.emission);
    params.status = pass.readWrite(buffers.status);
    params.sum_shift = job.sum_shift;
    pass.dispatchIndirect(buffers.args, gpu::kArgsMerge, params, buffers.bricks.count());
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
    for (std::uint32_t height = 0; height < job.tree.grid.nodeLevels() && job.tree.node_attributes.count() != 0;
         ++height)
    {
        vk::Pass pass = graph.addPass(gpu::update::Average{});
        gpu::OverlayAverageParams params{};
        params.scene = pass.read(job.tables);
        params.items = pass.read(buffers.work.items);
        params.ranges = pass.read(buffers.work.ranges);
        params.touched = pass.read(buffers.touched);
        params.nodes = pass.read(job.tree.nodes);
        params.children = height == 0 ? pass.read(job.tree.voxel_attributes) : pass.read(job.tree.node_attributes);
        params.averages = pass.readWrite(job.tree.node_attributes);
        params.status = pass.read(buffers.status);
        params.item_range = height;
        params.children_offset = height == 0 ? 0 : job.tree.attributeOffset();
        params.attribute_offset = job.tree.attributeOffset();
        pass.dispatchIndirect(buffers.work.args, height, params,
                              divideUp(buffers.work.items.count(), gpu::kNodesGroup));
    }
}

} // namespace

void showOverlay(vk::FrameGraph& graph, const UpdateJob& job, UpdateBuffers& buffers, const RootSlot& last)
{
    vk::Pass pass = graph.addPass(gpu::update::Finish{.attributes = job.tree.node_attributes.count() != 0});
    gpu::FinishParams params{};
    params.nodes = pass.readWrite(job.tree.nodes);
    params.node_attributes = pass.readWrite(job.tree.node_attributes);
    params.counters = pass.read(buffers.counters);
    params.status = pass.read(buffers.status);
    params.results = pass.readWrite(job.results);
    params.roots = pass.readWrite(job.roots);
    params.root = job.region.first_node;
    params.last_root = last.root;
    params.last_slot = last.slot;
    params.slot = job.slot;
    params.sum_shift = job.sum_shift;
    params.attribute_offset = job.tree.attributeOffset();
    pass.dispatch(1, params);
}

UpdateBuffers::UpdateBuffers(vk::Device& device, const UpdateCapacities& capacities, const Grid& grid)
    : layers(device, "update/layers", gpu::kLayersMax), links(device, "update/links", capacities.records),
      bricks(device, "update/bricks", capacities.touched), counters(device, "update/brick_counters", 1),
      heads(device, "update/heads", capacities.touched), touched(device, "update/touched", capacities.touched),
      work(device, capacities.touched), levels(device, "update/levels", gpu::kNodeLevelsMax),
      counts(device, "update/counts", capacities.overlay_nodes),
      partials(device, "update/partials", grid.nodeLevels() * divideUp(capacities.overlay_nodes, gpu::kScanBlock)),
      args(device, "update/args", gpu::kArgsCount), status(device, "update/status", 1)
{
}

std::uint64_t UpdateBuffers::bytes(const UpdateCapacities& capacities)
{
    return capacities.touched *
               (sizeof(gpu::BrickEntry) + sizeof(gpu::uint) + sizeof(gpu::TouchedNode) + sizeof(gpu::WorkItem)) +
           capacities.records * sizeof(gpu::LayerLink) + capacities.overlay_nodes * sizeof(gpu::uint);
}

void addMergeStages(const UpdateJob& job, UpdateBuffers& buffers, RecordedStages& stages)
{
    const std::uint64_t records = buffers.links.count();
    const auto add = [&](const char* name, const std::function<void(vk::FrameGraph&)>& record)
    {
        addStage(stages, {name, records},
                 [record](vk::FrameGraph& graph, std::uint64_t, std::uint64_t) { record(graph); });
    };
    add("list touched nodes",
        [&job, &buffers](vk::FrameGraph& graph)
        {
            listTouched(graph, job, buffers);
            mergeRoots(graph, job, buffers);
        });
    for (std::uint32_t level = 1; level < job.tree.grid.nodeLevels(); ++level)
    {
        add("copy and merge a level",
            [&job, &buffers, level](vk::FrameGraph& graph) { expandLevel(graph, job, buffers, level); });
    }
    if (job.tree.hasAttributes())
    {
        add("merge attributes", [&job, &buffers](vk::FrameGraph& graph) { mergeAttributes(graph, job, buffers); });
    }
}

void showRoot(vk::FrameGraph& graph, DeviceTree& tree, const vk::BufferOf<gpu::uint>& roots, const RootSlot& root)
{
    vk::Pass pass = graph.addPass(gpu::update::Show{.attributes = tree.node_attributes.count() != 0});
    gpu::ShowParams params{};
    params.nodes = pass.readWrite(tree.nodes);
    params.node_attributes = pass.readWrite(tree.node_attributes);
    params.roots = pass.read(roots);
    params.root = root.root;
    params.slot = root.slot;
    params.attribute_offset = tree.attributeOffset();
    pass.dispatch(1, params);
}

} // namespace zvo
