// SPDX-License-Identifier: MIT
#include "core/svdag/svdag_builder.h"

#include "core/base/divide_up.h"
#include "core/base/lanes.h"
#include "core/tree/leaf_words.h"
#include "core/tree/tree_limits.h"
#include "vk/device.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint64_t kSlotsMax = kIndicesMax; // of all levels
constexpr std::uint64_t kSlotsPerNodeMax = 16;   // with more, only equal hashes fill 256 slots in a row

[[noreturn]] void throwTooBig(const ListPacking& packing)
{
    throw Error(ErrorCode::Memory,
                fmt::format("the DAG has {} words of nodes and {} entries of lists, more than numbers "
                            "of 30 bits tell apart; lower the resolution",
                            packing.node_words, packing.entry_count));
}

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

// Enlarges the tables of levels that had too few slots. Returns false if there were none.
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

// Allocates the pool of dag for the nodes and entries that were counted.
void allocatePool(vk::Device& device, const Candidates& candidates, const gpu::ClassSizes& sizes, bool has_ranks,
                  std::uint32_t per_word_max, DeviceTree& dag)
{
    dag.node_count = sizes.node_count;
    dag.filled = candidates.tree.filled;
    const std::uint32_t full_entries = dag.fullEntries();
    dag.lists.entry_count = std::uint64_t{sizes.entry_count} + full_entries;
    const std::size_t level_count = candidates.levels().size();
    for (std::size_t level = 0; level < level_count; ++level)
    {
        const std::uint32_t end = level + 1 < level_count ? sizes.first_nodes[level + 1] : sizes.node_count;
        dag.levels.push_back({sizes.first_nodes[level], end - sizes.first_nodes[level]});
    }
    dag.lists.long_entry_count = full_entries + (level_count < 2 ? 0 : sizes.first_entries[level_count - 2]);
    dag.leaf_words = leafWordsOf(dag.levels);
    ListPacking packing = ListPacking::tightest(dag.nodeWords(), dag.nodeWords(), dag.lists.entry_count);
    packing.per_word = std::min(packing.per_word, per_word_max);
    dag.lists.entries_per_word = packing.per_word;
    if (!packing.fits(gpu::kLeafWords))
    {
        throwTooBig(packing);
    }
    const std::uint64_t before_count = has_ranks ? dag.lists.long_entry_count : 0;
    const std::uint64_t leaf_word_count =
        has_ranks ? divideUp(dag.lists.entry_count - dag.lists.long_entry_count, 2) : 0;
    const std::uint64_t below_count = has_ranks ? dag.levels.back().first_node : 0;
    device.memory().require(packing.poolNodes() * sizeof(gpu::Node) +
                                (before_count + below_count) * sizeof(gpu::BeforeChild) +
                                leaf_word_count * sizeof(gpu::uint),
                            "writing the DAG");
    dag.nodes = {device, "svdag/pool", packing.poolNodes()};
    dag.lists.before = {device, "svdag/before", before_count};
    dag.lists.voxels_before_leaf = {device, "svdag/voxels_before_leaf", leaf_word_count};
}

void writeLevel(vk::FrameGraph& graph, const Candidates& candidates, std::size_t level, const ClassBuffers& classes,
                vk::BufferOf<gpu::BeforeChild>& below, DeviceTree& dag)
{
    const auto [first_node, node_count] = dag.levels[level];
    if (level + 1 == dag.levels.size())
    {
        vk::Pass pass = graph.addPass(gpu::svdag::Leaves{.filled = dag.filled});
        const gpu::UniqueLeavesParams params = {
            pass.read(candidates.tree.nodes), pass.read(classes.table), pass.write(dag.nodes), first_node, node_count,
            candidates.reference(level),      candidates.surface()};
        pass.dispatch(node_count, params);
        return;
    }
    const bool above_leaves = level + 2 == dag.levels.size();
    vk::Pass pass = graph.addPass(gpu::svdag::Lists{.entries_per_word = candidates.tree.entriesPerWord(),
                                                    .before = below.count() != 0,
                                                    .above_leaves = above_leaves,
                                                    .per_word = dag.lists.entries_per_word,
                                                    .filled = dag.filled});
    gpu::UniqueListsParams params{};
    params.nodes = pass.read(candidates.tree.nodes);
    params.classes = pass.read(classes.classes);
    params.numbers = pass.read(classes.numbers);
    params.unique_nodes = pass.read(classes.table);
    params.first_entries = pass.read(classes.first_entries);
    params.pool = pass.readWrite(dag.nodes);
    params.halfwords = {params.pool.address};
    params.below = pass.readWrite(below);
    params.before = pass.write(dag.lists.before);
    params.voxels_before_leaf = pass.readWrite(dag.lists.voxels_before_leaf);
    params.first_node = first_node;
    params.node_count = node_count;
    params.first_index = static_cast<std::uint32_t>(dag.packing().firstEntry());
    params.long_entry_count = static_cast<std::uint32_t>(dag.lists.long_entry_count);
    params.child_reference = candidates.reference(level + 1);
    params.leaf_reference = above_leaves ? dag.leafReference() : 0;
    params.full_node = dag.node_count;
    pass.dispatch(node_count, params);
}

void writePool(vk::FrameGraph& graph, const Candidates& candidates, const ClassBuffers& classes,
               vk::BufferOf<gpu::BeforeChild>& below, DeviceTree& dag)
{
    if (dag.lists.entry_count != 0)
    {
        graph.fill(dag.nodes, 0, 2 * dag.nodeWords());
    }
    graph.fill(dag.lists.voxels_before_leaf, 0);
    for (std::size_t level = dag.levels.size(); level-- > 0;)
    {
        writeLevel(graph, candidates, level, classes, below, dag);
    }
}

// Where octree, and the classes of its nodes, lead in depth-first order. numbers become ranks.
void orderDepthFirst(vk::FrameGraph& graph, const DeviceTree& octree, ClassBuffers& classes, DeviceTree& dag)
{
    vk::BufferOf<gpu::uint>& ranks = classes.numbers;
    graph.fill(ranks, 0, 0, 1);
    for (std::size_t level = 0; level + 1 < octree.levels.size(); ++level)
    {
        const auto [first_node, node_count] = octree.levels[level];
        const bool above_leaves = level + 2 == octree.levels.size();
        const bool packed = isPacked(octree.attributeFormat());
        const std::uint32_t lanes = lanesOn(graph.device(), node_count);
        vk::Pass pass =
            graph.addPass(gpu::svdag::DepthFirst{.above_leaves = above_leaves, .packed = packed, .lanes = lanes});
        gpu::DepthFirstParams params{};
        params.nodes = pass.read(octree.nodes);
        params.classes = pass.read(classes.classes);
        params.first_entries = pass.read(classes.first_entries);
        params.before = {pass.read(dag.lists.before).address + dag.fullEntries() * sizeof(gpu::BeforeChild)};
        if (packed)
        {
            params.from = {pass.read(octree.packed.nodes).address};
            params.to = {pass.readWrite(dag.packed.nodes).address};
        }
        else
        {
            params.from = pass.read(octree.node_attributes);
            params.to = pass.readWrite(dag.node_attributes);
        }
        params.ranks = pass.readWrite(ranks);
        params.first_node = first_node;
        params.node_count = node_count;
        params.child_reference = above_leaves ? octree.leafReference() : 0;
        pass.dispatch(std::uint64_t{node_count} * lanes, params);
    }
}

// Moves what does not depend on equal nodes from one tree to the other.
void moveVoxels(DeviceTree& from, DeviceTree& to)
{
    to.grid = from.grid;
    to.voxel_count = from.voxel_count;
    to.filled = from.filled;
    to.interior_count = from.interior_count;
    to.voxel_attributes = std::move(from.voxel_attributes);
    to.packed.format = from.packed.format;
    to.packed.voxels = std::move(from.packed.voxels);
    to.emission_words = std::move(from.emission_words);
    to.emission = std::move(from.emission);
    to.emission_scale = from.emission_scale;
    to.sums = std::move(from.sums);
}

void requireLevels(const DeviceTree& tree)
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

SvdagBuilder::SvdagBuilder(vk::Device& device, DeviceTree source, const CompressOptions& options)
    : m_device(device), m_options(options), m_source(std::move(source)), m_candidates{m_source, options.hash_mask},
      m_has_ranks(m_source.hasAttributes() || options.ranks)
{
    requireLevels(m_source);
    if (m_source.filled && m_source.isDag())
    {
        throw Error(ErrorCode::Usage, "a filled DAG is not compressed again");
    }
    m_result.dag.structure = TreeStructure::Svdag;
    m_result.dag.lists.octree_node_count = m_source.octreeNodeCount();
    if (m_source.node_count == 0)
    {
        end();
        return;
    }
    m_step = {&SvdagBuilder::classify, &SvdagBuilder::learnClasses};
    for (const DeviceTree::Level& level : m_source.levels)
    {
        m_result.candidate_counts.push_back(level.node_count);
    }
}

void SvdagBuilder::classify(vk::FrameGraph& graph)
{
    if (!m_classes)
    {
        if (m_slot_counts.empty()) // not in the constructor: it has taken the tree over, and fails only before that
        {
            m_readback = {m_device, sizeof(gpu::ClassSizes)};
            m_slot_counts = classSlots(m_candidates, m_options.table_slots);
        }
        requireCountable(m_slot_counts);
        m_device.memory().require(ClassBuffers::bytes(m_candidates, m_slot_counts), "finding equal nodes");
        m_classes.emplace(m_device, m_candidates, m_slot_counts);
    }
    findClasses(graph, m_candidates, m_slot_counts, *m_classes);
    m_sizes_offset = m_readback.copy(graph, m_classes->sizes, 0, 1);
}

// Repeats the step with larger tables if they had too few slots.
void SvdagBuilder::learnClasses()
{
    const gpu::ClassSizes sizes = m_readback.at<gpu::ClassSizes>(m_sizes_offset, 1).front();
    if (growSlots(m_candidates, sizes, m_slot_counts))
    {
        m_classes.reset();
        requireCountable(m_slot_counts);
        ++m_result.retry_count;
        return;
    }
    m_classes->hashes = {};
    const std::uint32_t per_word_max = m_options.entries_per_word != 0 ? m_options.entries_per_word : UINT32_MAX;
    allocatePool(m_device, m_candidates, sizes, m_has_ranks, per_word_max, m_result.dag);
    m_step = {&SvdagBuilder::write, &SvdagBuilder::endNodes};
}

void SvdagBuilder::write(vk::FrameGraph& graph)
{
    const std::uint64_t below_count = m_has_ranks ? m_result.dag.levels.back().first_node : 0;
    if (m_below.count() != below_count)
    {
        m_below = {m_device, "svdag/below", below_count};
    }
    writePool(graph, m_candidates, *m_classes, m_below, m_result.dag);
}

// What attributes of nodes come to.
void SvdagBuilder::endNodes()
{
    m_below = {};
    m_classes->table = {};
    DeviceTree& source = m_source;
    if (!source.isDag() && source.levels.size() > 1 && (source.hasAttributes() || source.hasNodeAttributes()))
    {
        m_step = {&SvdagBuilder::order, &SvdagBuilder::end};
        return;
    }
    m_result.dag.node_attributes = std::move(source.node_attributes);
    m_result.dag.packed.nodes = std::move(source.packed.nodes);
    end();
}

void SvdagBuilder::order(vk::FrameGraph& graph)
{
    DeviceTree& tree = m_result.dag;
    const DeviceTree& source = m_source;
    if (tree.node_attributes.count() + tree.packed.nodes.count() == 0)
    {
        tree.node_attributes = {m_device, "svdag/node_attributes", source.node_attributes.count()};
        tree.packed.nodes = {m_device, "packed node attributes", source.packed.nodes.count()};
    }
    orderDepthFirst(graph, source, *m_classes, m_result.dag);
}

void SvdagBuilder::end()
{
    moveVoxels(m_source, m_result.dag);
    m_source = {};
    m_classes.reset();
    finish();
}

} // namespace zvo
