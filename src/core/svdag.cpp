// SPDX-License-Identifier: MIT
#include "core/svdag.h"

#include "core/divide_up.h"
#include "core/svdag_classes.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint64_t kSlotsMax = UINT32_MAX; // of all levels: kernels count in 32 bits
constexpr std::uint64_t kSlotsPerNodeMax = 16;  // with more, only equal hashes fill 256 slots in a row

[[noreturn]] void throwTooBig(const ListPacking& packing)
{
    throw Error(ErrorCode::Memory, fmt::format("the DAG has {} nodes and {} entries of lists, more than numbers of 31 "
                                               "bits tell apart; lower the resolution",
                                               packing.node_count, packing.entry_count));
}

void append(std::vector<vk::PassTime>& passes, std::vector<vk::PassTime>&& more)
{
    passes.insert(passes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

struct Classes
{
    ClassBuffers buffers;
    gpu::ClassSizes sizes;
};

void requireCountable(std::span<const std::uint64_t> slot_counts)
{
    const std::uint64_t slots = std::reduce(slot_counts.begin(), slot_counts.end());
    if (slots > kSlotsMax)
    {
        throw Error(ErrorCode::Memory, fmt::format("the table of equal nodes takes {} slots, but {} can be told apart; "
                                                   "lower the resolution",
                                                   slots, kSlotsMax));
    }
}

// Grows the tables of levels that had too few slots. False: there were none.
bool growSlots(const Candidates& candidates, const gpu::ClassSizes& sizes, std::vector<std::uint64_t>& slot_counts)
{
    bool grown = false;
    for (std::size_t level = 0; level < slot_counts.size(); ++level)
    {
        if (sizes.overflow_counts[level] == 0)
        {
            continue;
        }
        if (slot_counts[level] > kSlotsPerNodeMax * candidates.levels()[level].node_count)
        {
            throw Error(ErrorCode::Other, fmt::format("more than {} different nodes of level {} have the same hash",
                                                      gpu::kClassProbesMax, level));
        }
        slot_counts[level] *= 4;
        grown = true;
    }
    return grown;
}

Classes classify(vk::HeadlessDevice& device, const Candidates& candidates, const CompressOptions& options,
                 CompressResult& result)
{
    std::vector<std::uint64_t> slot_counts = classSlots(candidates, options.table_slots);
    for (;; ++result.retry_count)
    {
        requireCountable(slot_counts);
        device.device().memory().require(ClassBuffers::bytes(candidates, slot_counts), "finding equal nodes");
        ClassBuffers buffers(device.device(), candidates, slot_counts);
        std::vector<vk::PassTime> passes =
            device.run([&](vk::FrameGraph& graph) { findClasses(graph, candidates, slot_counts, buffers); });
        const gpu::ClassSizes sizes = device.download(buffers.sizes).front();
        if (!growSlots(candidates, sizes, slot_counts))
        {
            append(result.passes, std::move(passes));
            return {std::move(buffers), sizes};
        }
    }
}

// Sizes dag from what the classes came to.
void allocatePool(vk::Device& device, const Candidates& candidates, const gpu::ClassSizes& sizes, bool has_ranks,
                  std::uint32_t per_word_max, Svdag& dag)
{
    dag.tree.node_count = sizes.node_count;
    dag.entry_count = sizes.entry_count;
    const std::size_t level_count = candidates.levels().size();
    for (std::size_t level = 0; level < level_count; ++level)
    {
        const std::uint32_t end = level + 1 < level_count ? sizes.first_nodes[level + 1] : sizes.node_count;
        dag.tree.levels.push_back({sizes.first_nodes[level], end - sizes.first_nodes[level]});
    }
    dag.long_entry_count = level_count < 2 ? 0 : sizes.first_entries[level_count - 2];
    ListPacking packing = ListPacking::tightest(sizes.node_count, sizes.entry_count);
    packing.per_word = std::min(packing.per_word, per_word_max);
    dag.entries_per_word = packing.per_word;
    if (!packing.fits())
    {
        throwTooBig(packing);
    }
    const std::uint64_t before_count = has_ranks ? dag.long_entry_count : 0;
    const std::uint64_t leaf_word_count = has_ranks ? divideUp(dag.entry_count - dag.long_entry_count, 2) : 0;
    const std::uint64_t below_count = has_ranks ? dag.tree.levels.back().first_node : 0;
    device.memory().require(packing.poolNodes() * sizeof(gpu::Node) +
                                (before_count + below_count) * sizeof(gpu::BeforeChild) +
                                leaf_word_count * sizeof(gpu::uint),
                            "writing the DAG");
    dag.tree.nodes = {device, "svdag/pool", packing.poolNodes()};
    dag.before = {device, "svdag/before", before_count};
    dag.voxels_before_leaf = {device, "svdag/voxels_before_leaf", leaf_word_count};
}

void writeLevel(vk::FrameGraph& graph, const Candidates& candidates, std::size_t level, const ClassBuffers& classes,
                vk::BufferOf<gpu::BeforeChild>& below, Svdag& dag)
{
    const auto [first_node, node_count] = dag.tree.levels[level];
    if (level + 1 == dag.tree.levels.size())
    {
        vk::Pass pass = graph.addPass("svdag/leaves");
        const gpu::UniqueLeavesParams params = {pass.read(candidates.tree.nodes), pass.read(classes.table),
                                                pass.write(dag.tree.nodes), first_node, node_count};
        pass.dispatch(node_count, params);
        return;
    }
    const bool above_leaves = level + 2 == dag.tree.levels.size();
    const std::uint32_t has_before = below.count() != 0 ? 1 : 0;
    vk::Pass pass = graph.addPass(
        "svdag/lists", {candidates.entries_per_word, has_before, above_leaves ? 1U : 0U, dag.entries_per_word});
    gpu::UniqueListsParams params{};
    params.nodes = pass.read(candidates.tree.nodes);
    params.classes = pass.read(classes.classes);
    params.numbers = pass.read(classes.numbers);
    params.unique_nodes = pass.read(classes.table);
    params.first_entries = pass.read(classes.first_entries);
    params.pool = pass.readWrite(dag.tree.nodes);
    params.halfwords = {params.pool.address};
    params.below = pass.readWrite(below);
    params.before = pass.write(dag.before);
    params.voxels_before_leaf = pass.readWrite(dag.voxels_before_leaf);
    params.first_node = first_node;
    params.node_count = node_count;
    params.first_place = static_cast<std::uint32_t>(dag.packing().firstPlace());
    params.long_entry_count = static_cast<std::uint32_t>(dag.long_entry_count);
    pass.dispatch(node_count, params);
}

void writePool(vk::FrameGraph& graph, const Candidates& candidates, const ClassBuffers& classes,
               vk::BufferOf<gpu::BeforeChild>& below, Svdag& dag)
{
    if (dag.entry_count != 0)
    {
        graph.fill(dag.tree.nodes, 0, dag.tree.node_count * (sizeof(gpu::Node) / sizeof(gpu::uint)));
    }
    graph.fill(dag.voxels_before_leaf, 0);
    for (std::size_t level = dag.tree.levels.size(); level-- > 0;)
    {
        writeLevel(graph, candidates, level, classes, below, dag);
    }
}

// Where octree, and the classes of its nodes, lead in depth-first order. numbers become ranks.
void orderDepthFirst(vk::FrameGraph& graph, const Octree& octree, ClassBuffers& classes, Svdag& dag)
{
    vk::BufferOf<gpu::uint>& ranks = classes.numbers;
    graph.fill(ranks, 0, 0, 1);
    for (std::size_t level = 0; level + 1 < octree.levels.size(); ++level)
    {
        const auto [first_node, node_count] = octree.levels[level];
        const bool above_leaves = level + 2 == octree.levels.size();
        const bool packed = isPacked(octree.attributeForm());
        vk::Pass pass = graph.addPass("svdag/depth_first", {0U, above_leaves ? 1U : 0U, packed ? 1U : 0U});
        gpu::DepthFirstParams params{};
        params.nodes = pass.read(octree.nodes);
        params.classes = pass.read(classes.classes);
        params.first_entries = pass.read(classes.first_entries);
        params.before = pass.read(dag.before);
        if (packed)
        {
            params.from = {pass.read(octree.packed.nodes).address};
            params.to = {pass.readWrite(dag.tree.packed.nodes).address};
        }
        else
        {
            params.from = pass.read(octree.node_attributes);
            params.to = pass.readWrite(dag.tree.node_attributes);
        }
        params.ranks = pass.readWrite(ranks);
        params.first_node = first_node;
        params.node_count = node_count;
        pass.dispatch(node_count, params);
    }
}

// All of the DAG but attributes and what of an octree stays as it is.
Classes compressNodes(vk::HeadlessDevice& device, const Candidates& candidates, bool has_ranks,
                      const CompressOptions& options, CompressResult& result)
{
    for (const Octree::Level& level : candidates.levels())
    {
        result.candidate_counts.push_back(level.node_count);
    }
    Classes classes = classify(device, candidates, options, result);
    classes.buffers.hashes = {};
    Svdag& dag = result.dag;
    allocatePool(device.device(), candidates, classes.sizes, has_ranks,
                 options.entries_per_word != 0 ? options.entries_per_word : UINT32_MAX, dag);
    vk::BufferOf<gpu::BeforeChild> below(device.device(), "svdag/below",
                                         has_ranks ? dag.tree.levels.back().first_node : 0);
    append(result.passes,
           device.run([&](vk::FrameGraph& graph) { writePool(graph, candidates, classes.buffers, below, dag); }));
    return classes;
}

// What does not depend on equal nodes goes from one tree to the other.
void moveVoxels(Octree& from, Octree& to)
{
    to.grid = from.grid;
    to.voxel_count = from.voxel_count;
    to.voxel_attributes = std::move(from.voxel_attributes);
    to.packed.form = from.packed.form;
    to.packed.voxels = std::move(from.packed.voxels);
    to.emission_words = std::move(from.emission_words);
    to.emission = std::move(from.emission);
    to.emission_scale = from.emission_scale;
}

void requireLevels(const Octree& tree)
{
    if (tree.node_count != 0 && tree.levels.size() != tree.grid.nodeLevels())
    {
        throw Error(ErrorCode::Usage, "only a tree whose nodes stand level by level can be compressed");
    }
}

} // namespace

double CompressResult::ms() const
{
    double sum = 0;
    for (const vk::PassTime& pass : passes)
    {
        sum += pass.ms;
    }
    return sum;
}

gpu::RankSource rankSource(vk::Pass& pass, const Svdag& dag)
{
    const std::uint64_t first_place = dag.packing().firstPlace();
    gpu::RankSource source{};
    source.pool = pass.read(dag.tree.nodes);
    source.before = {pass.read(dag.before).address - first_place * sizeof(gpu::BeforeChild)};
    source.voxels_before_leaf = pass.read(dag.voxels_before_leaf);
    source.first_short_place = static_cast<gpu::uint>(first_place + dag.long_entry_count);
    return source;
}

CompressResult compress(vk::HeadlessDevice& device, Octree octree, const CompressOptions& options)
{
    requireLevels(octree);
    CompressResult result;
    Svdag& dag = result.dag;
    dag.octree_node_count = octree.node_count;
    if (octree.node_count != 0)
    {
        Classes classes = compressNodes(device, {octree, 0, options.hash_mask}, octree.hasAttributes() || options.ranks,
                                        options, result);
        classes.buffers.table = {};
        if (octree.levels.size() < 2) // one node
        {
            dag.tree.node_attributes = std::move(octree.node_attributes);
            dag.tree.packed.nodes = std::move(octree.packed.nodes);
        }
        else if (octree.hasAttributes())
        {
            dag.tree.node_attributes = {device.device(), "svdag/node_attributes", octree.node_attributes.count()};
            dag.tree.packed.nodes = {device.device(), "packed node attributes", octree.packed.nodes.count()};
            append(result.passes,
                   device.run([&](vk::FrameGraph& graph) { orderDepthFirst(graph, octree, classes.buffers, dag); }));
        }
    }
    moveVoxels(octree, dag.tree);
    return result;
}

CompressResult compress(vk::HeadlessDevice& device, Svdag dag, const CompressOptions& options)
{
    requireLevels(dag.tree);
    CompressResult result;
    result.dag.octree_node_count = dag.octree_node_count;
    if (dag.tree.node_count != 0)
    {
        compressNodes(device, {dag.tree, dag.entries_per_word, options.hash_mask},
                      dag.tree.hasAttributes() || options.ranks, options, result);
    }
    moveVoxels(dag.tree, result.dag.tree);
    result.dag.tree.node_attributes = std::move(dag.tree.node_attributes);
    result.dag.tree.packed.nodes = std::move(dag.tree.packed.nodes);
    return result;
}

} // namespace zvo
