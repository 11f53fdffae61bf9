// SPDX-License-Identifier: MIT
#include "core/algebra/tree_operator.h"

#include "core/algebra/node_places.h"
#include "core/base/divide_up.h"
#include "core/tree/tree_limits.h"
#include "core/voxelize/fragment_sums.h"
#include "zvo/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace zvo
{

static_assert(static_cast<gpu::uint>(TreeOperation::Unite) == gpu::kUnite);
static_assert(static_cast<gpu::uint>(TreeOperation::Intersect) == gpu::kIntersect);
static_assert(static_cast<gpu::uint>(TreeOperation::Subtract) == gpu::kSubtract);
static_assert(static_cast<gpu::uint>(TreeOperation::Keep) == gpu::kKeep);
static_assert(static_cast<gpu::uint>(TreeOperation::Enclose) == gpu::kEnclose);
static_assert(static_cast<gpu::uint>(TreeOperation::Dilate) == gpu::kDilate);
static_assert(static_cast<gpu::uint>(TreeOperation::Erode) == gpu::kErode);

namespace
{

constexpr std::uint64_t kBricksMin = 64;
constexpr std::uint32_t kBrickEdge = 1U << gpu::kBrickLog2;
constexpr std::uint32_t kLeafEdge = 4;
constexpr std::uint32_t kLeafLevels = 2; // levels of nodes from bricks down

bool decidesByVoxel(TreeOperation operation)
{
    return operation < TreeOperation::Dilate;
}

std::uint64_t bricksOf(const DeviceTree& tree)
{
    return tree.levels.empty() ? 0 : tree.levels[tree.levels.size() - kLeafLevels].node_count;
}

gpu::Looks looksOf(const DeviceTree& tree)
{
    return {{tree.voxel_attributes.address()}, {tree.emission_words.address()}, {tree.emission.address()}};
}

} // namespace

TreeOperator::TreeOperator(vk::Device& device, const GpuScene& color_tables, const OperationInfo& info)
    : m_device(device), m_tables(color_tables), m_info(info), m_no_nodes(device, "algebra/no_nodes", 1)
{
    const DeviceTree& a = *info.a;
    const DeviceTree& b = second();
    requireOperand(a);
    requireOperand(b);
    if (a.grid != b.grid)
    {
        throw Error(ErrorCode::Usage, "algebra takes trees of the same grid: resolution, origin and voxel size");
    }
    const bool has_nothing = a.voxel_count == 0 || b.voxel_count == 0;
    if (a.hasAttributes() != b.hasAttributes() && !has_nothing)
    {
        throw Error(ErrorCode::Usage, "algebra takes trees of which all or none have attributes");
    }
    m_attributes = a.hasAttributes() || b.hasAttributes();
    m_emits = a.emission.count() + b.emission.count() != 0;
    if (m_emits && a.emission.count() != 0 && b.emission.count() != 0 && a.emission_scale != b.emission_scale)
    {
        throw Error(ErrorCode::Usage, "algebra takes trees whose emission has the same scale");
    }
    m_filled = info.operation == TreeOperation::Unite       ? a.filled || b.filled
               : info.operation == TreeOperation::Intersect ? a.filled && b.filled
                                                            : a.filled || info.operation == TreeOperation::Enclose;
    m_result.octree.grid = a.grid;
    m_result.octree.emission_scale = a.emission.count() != 0 ? a.emission_scale : b.emission_scale;
    m_capacities.bricks = std::max(kBricksMin, bricksOf(a) + (hasTwo() ? bricksOf(b) : 0));
    m_capacities.table = std::bit_ceil(2 * m_capacities.bricks);
    m_readback = {device, kBrickReadbackBytes};
    m_step = {&TreeOperator::list, &TreeOperator::learnBricks};
}

std::uint32_t TreeOperator::bricksAlong() const
{
    return static_cast<std::uint32_t>(divideUp(m_result.octree.grid.resolution(), kBrickEdge));
}

std::uint32_t TreeOperator::leavesAlong() const
{
    return m_result.octree.grid.resolution() / kLeafEdge;
}

gpu::Operand TreeOperator::readOperand(vk::AnyPass& pass, const DeviceTree& tree)
{
    return {tree.node_count == 0 ? pass.read(m_no_nodes) : pass.read(tree.nodes), pass.read(tree.leaf_groups)};
}

void TreeOperator::listBricksOf(vk::FrameGraph& graph, const DeviceTree& tree, vk::BufferOf<gpu::uvec2>& places)
{
    if (tree.node_count == 0)
    {
        return;
    }
    const std::size_t brick_levels = tree.levels.size() - 1;
    if (places.count() == 0)
    {
        places = {m_device, "algebra/places", nodesOf(tree, brick_levels)};
    }
    placeNodes(graph, tree, brick_levels, places);
    const auto [first_node, node_count] = tree.levels[brick_levels - 1];
    const bool grows = m_info.operation == TreeOperation::Dilate;
    const bool exposes = m_info.a->filled && (m_info.operation == TreeOperation::Erode ||
                                              (m_info.operation == TreeOperation::Subtract && &tree == m_info.b));
    vk::Pass pass = graph.addPass(
        gpu::algebra::ListAlgebra{.wide_keys = hasWideKeys(tree.grid), .grows = grows, .exposes = exposes});
    pass.dispatch(node_count, {.tree = readOperand(pass, tree),
                               .a = readOperand(pass, *m_info.a),
                               .places = pass.read(places),
                               .bricks = pass.readWrite(m_bricks->voxelize.table),
                               .counters = pass.readWrite(m_bricks->voxelize.counters),
                               .brick_mask = static_cast<std::uint32_t>(m_bricks->voxelize.table.count() - 1),
                               .brick_levels = static_cast<std::uint32_t>(brick_levels - 1),
                               .first_node = first_node,
                               .node_count = node_count,
                               .brick_count = bricksAlong()});
}

template <typename Kernel> void TreeOperator::cells(vk::FrameGraph& graph)
{
    VoxelizeBuffers& bricks = m_bricks->voxelize;
    vk::Pass pass = graph.addPass(Kernel{.wide_keys = hasWideKeys(m_result.octree.grid),
                                         .operation = m_info.operation,
                                         .corners = m_info.corners,
                                         .filled = m_filled});
    gpu::AlgebraParams params{};
    params.a = readOperand(pass, *m_info.a);
    params.b = readOperand(pass, second());
    params.masks = m_info.masks != nullptr ? pass.read(*m_info.masks) : gpu::ConstPtr<gpu::uvec2>{};
    params.bricks = pass.read(bricks.table);
    params.ranges = pass.read(bricks.ranges);
    params.counters = pass.read(bricks.counters);
    params.brick_masks = {pass.readWrite(bricks.masks).address};
    params.inside = {pass.readWrite(bricks.crossings).address};
    params.full = pass.readWrite(m_full);
    params.brick_mask = static_cast<std::uint32_t>(bricks.table.count() - 1);
    params.brick_levels = m_result.octree.grid.nodeLevels() - kLeafLevels;
    params.leaf_count = leavesAlong();
    pass.dispatchIndirect(bricks.counters, &gpu::BinCounters::leaves, params, bricks.ranges.count());
}

void TreeOperator::listFull(vk::FrameGraph& graph)
{
    const Grid& grid = m_result.octree.grid;
    VoxelizeBuffers& bricks = m_bricks->voxelize;
    OctreeBuildBuffers& work = m_bricks->work;
    for (std::uint32_t height = 1; height + 1 < grid.nodeLevels(); ++height)
    {
        vk::Pass pass = graph.addPass(gpu::algebra::FullNodes{.wide_keys = hasWideKeys(grid),
                                                              .operation = m_info.operation,
                                                              .corners = m_info.corners,
                                                              .filled = m_filled});
        gpu::AlgebraNodesParams params{};
        params.a = readOperand(pass, *m_info.a);
        params.b = readOperand(pass, second());
        params.masks = m_info.masks != nullptr ? pass.read(*m_info.masks) : gpu::ConstPtr<gpu::uvec2>{};
        params.bricks = pass.readWrite(bricks.table);
        params.full = pass.read(m_full);
        params.items = pass.read(work.items);
        params.ranges = pass.read(work.ranges);
        params.counters = pass.readWrite(work.counters);
        params.brick_mask = static_cast<std::uint32_t>(bricks.table.count() - 1);
        params.brick_levels = grid.nodeLevels() - kLeafLevels;
        params.height = height;
        pass.dispatchIndirect(work.args, height, params, divideUp(work.items.count(), gpu::kNodesGroup));
    }
}

void TreeOperator::list(vk::FrameGraph& graph)
{
    if (!m_bricks)
    {
        VoxelForm form;
        form.attributes = m_attributes;
        form.fill = m_filled ? Fill::Solid : Fill::None;
        const std::uint64_t mask_words = m_capacities.bricks * gpu::kLeafMaskWords * (m_filled ? 3 : 1);
        m_device.memory().require(m_capacities.table * sizeof(gpu::BrickEntry) +
                                      m_capacities.bricks * sizeof(gpu::BrickRange) + mask_words * sizeof(gpu::uint) +
                                      OctreeBuildBuffers::bytes(m_capacities.table, m_capacities.bricks),
                                  "the bricks of an operation");
        m_full = {m_device, "algebra/full", divideUp(m_capacities.table, 32)};
        m_bricks.emplace(
            OctreeBricks{{m_device, m_capacities, form}, {m_device, m_capacities.table, m_capacities.bricks}, {}});
    }
    VoxelizeBuffers& bricks = m_bricks->voxelize;
    graph.fill(m_no_nodes, 0);
    graph.fill(bricks.table, 0);
    graph.fill(bricks.counters, 0);
    graph.fill(m_full, 0);
    listBricksOf(graph, *m_info.a, m_places);
    if (hasTwo())
    {
        listBricksOf(graph, *m_info.b, m_other_places);
    }
    listBricks(graph, bricks, gpu::kAlgebraGroup);
    if (decidesByVoxel(m_info.operation))
    {
        cells<gpu::algebra::Combine>(graph);
    }
    else
    {
        cells<gpu::algebra::Spread>(graph);
    }
    if (m_filled)
    {
        cells<gpu::algebra::Surface>(graph);
    }
    const GridTile tile(m_result.octree.grid);
    listNodes(graph, tile, bricks, m_bricks->work);
    if (m_filled)
    {
        listFull(graph);
    }
    m_counts = copyCounts(graph, m_readback, *m_bricks, tile.grid.nodeLevels());
}

void TreeOperator::learnBricks()
{
    const BrickCounts counts = readCounts(m_readback, m_counts, m_result.octree.grid.nodeLevels());
    gpu::BinCounters bins = counts.bins;
    bins.overflow_count += counts.nodes.overflow_count;
    const VoxelizeCapacities grown = m_capacities.grownFor(bins);
    if (grown != m_capacities)
    {
        m_bricks.reset();
        m_capacities = grown;
        ++m_result.retry_count;
        return;
    }
    if (bins.voxel_carry != 0)
    {
        throwUncountable("voxels");
    }
    m_places = {};
    m_other_places = {};
    allocateNodes(m_device, counts, *m_bricks, m_result.octree);
    if (m_result.octree.node_count == 0)
    {
        end();
        return;
    }
    m_step = {&TreeOperator::number, &TreeOperator::endNumbers};
}

void TreeOperator::number(vk::FrameGraph& graph)
{
    numberBricks(graph, *m_bricks, m_result.octree);
}

void TreeOperator::endNumbers()
{
    m_occupied = std::move(m_bricks->leaves.occupied);
    m_bricks.reset();
    if (m_attributes)
    {
        m_step = {&TreeOperator::looks, &TreeOperator::learnEmission};
        return;
    }
    m_step = {&TreeOperator::average, &TreeOperator::end};
}

void TreeOperator::lookPass(vk::FrameGraph& graph, bool emission)
{
    DeviceTree& octree = m_result.octree;
    const auto [first_brick, brick_count] = octree.levels[octree.levels.size() - kLeafLevels];
    vk::Pass pass = graph.addPass(gpu::algebra::FindLooks{.operation = m_info.operation,
                                                          .corners = m_info.corners,
                                                          .filled = m_filled,
                                                          .emits = m_emits,
                                                          .emission = emission});
    for (const DeviceTree* const tree : {m_info.a, &second()})
    {
        pass.read(tree->voxel_attributes);
        pass.read(tree->emission_words);
        pass.read(tree->emission);
    }
    gpu::LooksParams params{};
    params.scene = readColorTables(pass, m_tables);
    params.a = readOperand(pass, *m_info.a);
    params.b = readOperand(pass, second());
    params.looks = pass.read(m_looks);
    params.node_looks = pass.read(m_info.a->node_attributes);
    params.nodes = pass.read(octree.nodes);
    params.occupied = pass.read(m_occupied);
    params.places = pass.read(m_places);
    params.attributes = pass.readWrite(octree.voxel_attributes);
    params.emission_words = pass.readWrite(octree.emission_words);
    params.emission = pass.readWrite(octree.emission);
    params.first_leaf = octree.levels.back().first_node;
    params.first_brick = first_brick;
    params.brick_count = brick_count;
    params.leaf_edge = leavesAlong();
    pass.dispatch(std::uint64_t{brick_count} * gpu::kAlgebraGroup, params);
}

void TreeOperator::looks(vk::FrameGraph& graph)
{
    DeviceTree& octree = m_result.octree;
    if (m_looks.count() == 0)
    {
        const std::uint64_t word_count = m_emits ? divideUp(octree.voxel_count, gpu::kVoxelsPerEmissionWord) : 0;
        m_device.memory().require(octree.voxel_count * sizeof(gpu::Attribute) +
                                      (word_count + octree.node_count) * sizeof(gpu::uvec2),
                                  "the attributes of an octree");
        octree.voxel_attributes = {m_device, "octree/voxel_attributes", octree.voxel_count};
        octree.emission_words = {m_device, "octree/emission_words", word_count};
        m_partials = {m_device, "algebra/partials", divideUp(word_count, gpu::kScanBlock)};
        m_emissive_count = {m_device, "algebra/emissive_count", 1};
        m_places = {m_device, "algebra/places", nodesOf(octree, octree.levels.size() - 1)};
        m_looks = {m_device, "algebra/looks", 2};
    }
    graph.update(m_looks, 0, std::array{looksOf(*m_info.a), looksOf(second())});
    placeNodes(graph, octree, octree.levels.size() - 1, m_places);
    if (m_emits)
    {
        graph.fill(octree.emission_words, 0);
    }
    lookPass(graph, false);
    if (m_emits)
    {
        rankBits(graph, octree.emission_words, m_partials, m_emissive_count);
        m_emissive_offset = m_readback.copy(graph, m_emissive_count, 0, 1);
    }
}

void TreeOperator::learnEmission()
{
    DeviceTree& octree = m_result.octree;
    const std::uint32_t emissive = m_emits ? m_readback.at<gpu::uint>(m_emissive_offset, 1).front() : 0;
    if (emissive != 0)
    {
        octree.emission = {m_device, "octree/emission", emissive};
        m_step = {&TreeOperator::emission, &TreeOperator::beginAverages};
        return;
    }
    octree.emission_words = {};
    beginAverages();
}

void TreeOperator::emission(vk::FrameGraph& graph)
{
    lookPass(graph, true);
}

void TreeOperator::beginAverages()
{
    m_places = {};
    m_step = {&TreeOperator::average, &TreeOperator::end};
}

void TreeOperator::average(vk::FrameGraph& graph)
{
    if (m_attributes)
    {
        averageOctree(graph, m_tables, m_filled, m_result.octree);
    }
    addLeafWords(graph, m_occupied, m_result.octree, m_pool);
}

void TreeOperator::end()
{
    m_bricks.reset();
    takePool(std::move(m_pool), m_filled, m_result.octree);
    m_occupied = {};
    finish();
}

} // namespace zvo
