// SPDX-License-Identifier: MIT
#include "core/octree/octree_builder.h"

#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "core/tree/leaf_words.h"
#include "core/tree/tree_limits.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace zvo
{

namespace
{

// Counters, those of rasterization or of bricks, level ranges.
constexpr std::uint64_t kReadbackBytes = 1024;

constexpr std::uint32_t kRetriesMax = 32; // a table of one brick grows to the largest in half of them

[[noreturn]] void throwTooBig(const char* what)
{
    throw Error(ErrorCode::Memory,
                fmt::format("the scene makes more {} than 32-bit numbers count; lower the resolution, "
                            "or split the scene",
                            what));
}

// Bytes of everything that the coverage step allocates.
std::uint64_t coverageBytes(const VoxelizeCapacities& capacities, const GpuScene& scene, bool mixed)
{
    std::uint64_t bytes = VoxelizeBuffers::brickBytes(capacities.bricks, mixed) +
                          capacities.bricks * sizeof(gpu::WorkItem) +
                          divideUp(capacities.bricks, gpu::kScanBlock) * sizeof(gpu::uint);
    for (const TriangleChunks& chunks : scene.chunks)
    {
        if (chunks.workgroups() != 0)
        {
            bytes +=
                capacities.big_triangles * sizeof(gpu::BigTriangle) + capacities.row_blocks * sizeof(gpu::RowBlock);
        }
    }
    return bytes;
}

// Rounds the table's capacity up to a power of two, whatever was asked for.
VoxelizeCapacities usable(VoxelizeCapacities capacities)
{
    constexpr std::uint64_t kListMax = UINT32_MAX; // kernels count in 32 bits
    capacities.bricks = std::bit_ceil(std::clamp<std::uint64_t>(capacities.bricks, 1, VoxelizeCapacities::kBricksMax));
    capacities.big_triangles = std::min(capacities.big_triangles, kListMax);
    capacities.row_blocks = std::min(capacities.row_blocks, kListMax);
    return capacities;
}

// The expected row blocks of all bands: those without room count like the others, and an eighth is added.
std::uint64_t likelyRowBlocks(const gpu::RasterCounters& raster, std::uint64_t band_capacity)
{
    const std::uint64_t blocks = raster.block_count;
    if (raster.big_count <= band_capacity || band_capacity == 0)
    {
        return blocks;
    }
    const double scaled = static_cast<double>(blocks) * raster.big_count / static_cast<double>(band_capacity);
    return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(scaled * 1.125), blocks, gpu::kRowBlocksMax);
}

// Returns the growth that a run needs; nothing if everything sufficed.
std::optional<OctreeBuilder::Growth> growthOf(const VoxelizeCapacities& tried, const gpu::BrickCounters& bricks,
                                              const std::vector<gpu::RasterCounters>& rasters)
{
    OctreeBuilder::Growth growth = {tried, tried};
    bool grown = false;
    const auto hasOverflowed = [](const gpu::RasterCounters& raster) { return raster.overflow_count != 0; };
    if (bricks.overflow_count != 0 || std::ranges::any_of(rasters, hasOverflowed))
    {
        if (tried.bricks >= VoxelizeCapacities::kBricksMax)
        {
            throwTooBig("octree nodes");
        }
        growth.needed.bricks = 2 * tried.bricks;
        growth.likely.bricks = std::min(4 * tried.bricks, VoxelizeCapacities::kBricksMax);
        grown = true;
    }
    for (const gpu::RasterCounters& raster : rasters)
    {
        if (raster.blocks_exceeded != 0)
        {
            throwTooBig("pieces of large triangles");
        }
        grown = grown || raster.big_count > tried.big_triangles || raster.block_count > tried.row_blocks;
        for (VoxelizeCapacities* capacities : {&growth.needed, &growth.likely})
        {
            capacities->big_triangles = std::max<std::uint64_t>(capacities->big_triangles, raster.big_count);
            capacities->row_blocks = std::max<std::uint64_t>(capacities->row_blocks, raster.block_count);
        }
        growth.likely.row_blocks = std::max(growth.likely.row_blocks, likelyRowBlocks(raster, tried.big_triangles));
    }
    return grown ? std::optional(growth) : std::nullopt;
}

// Whether the scene's triangles have voxels of their own. In a dense mesh nearly all voxels are mixed, and telling them
// from others gains nothing; and an item of a brick is hardly more than a voxel.
bool hasLargeTriangles(const GpuScene& scene, const Grid& grid)
{
    constexpr double kVoxelsOfTriangle = 2;
    const double voxel = grid.voxel_size;
    return scene.surface_area >= kVoxelsOfTriangle * voxel * voxel * static_cast<double>(scene.triangle_count);
}

// Whether voxelization by bricks cannot take the scene: it has too many items, or a triangle is too large.
bool areBeyondBricks(const gpu::BinCounters& bins)
{
    return bins.item_carry != 0 || bins.wide_count != 0 || bins.item_count > kIndicesMax ||
           bins.brick_count > kIndicesMax / (2 * gpu::kLeafMaskWords);
}

bool haveRoom(const BrickCapacities& capacities, bool mixed, const vk::Device& device)
{
    return capacities.entries <= VoxelizeCapacities::kBricksMax &&
           capacities.bytes(mixed) <= device.memory().roomBytes() &&
           capacities.largestBytes(mixed) <= device.report().max_buffer_bytes;
}

// The capacities that a run by bricks needs, as far as it tells.
BrickCapacities grownFor(const gpu::BinCounters& bins, const gpu::BrickCounters& nodes, const BrickCapacities& tried)
{
    BrickCapacities grown = tried;
    grown.bricks = std::max<std::uint64_t>(tried.bricks, bins.brick_count);
    grown.items = std::max<std::uint64_t>(tried.items, bins.item_count);
    grown.large = std::max<std::uint64_t>(tried.large, bins.large_count);
    grown.entries = std::max(tried.entries, std::bit_ceil(2 * grown.bricks));
    if (bins.overflow_count + nodes.overflow_count != 0)
    {
        grown.entries = std::max(grown.entries, 4 * tried.entries);
    }
    return grown;
}

std::map<std::string, std::uint64_t> droppedTriangles(const std::vector<gpu::RasterCounters>& rasters)
{
    std::map<std::string, std::uint64_t> dropped;
    for (const gpu::RasterCounters& raster : rasters)
    {
        dropped["nonfinite"] += raster.nonfinite;
        dropped["out_of_range"] += raster.out_of_range;
        dropped["outside"] += raster.outside;
        dropped["zero_area"] += raster.zero_area;
    }
    std::erase_if(dropped, [](const auto& entry) { return entry.second == 0; });
    return dropped;
}

} // namespace

double operationMs(std::span<const vk::PassTime> passes, std::string_view operation)
{
    constexpr std::string_view kFill = "fill ";
    double ms = 0;
    for (const vk::PassTime& pass : passes)
    {
        std::string_view name = pass.name;
        name.remove_prefix(name.starts_with(kFill) ? kFill.size() : 0);
        ms += name.starts_with(operation) && name.substr(operation.size()).starts_with('/') ? pass.ms : 0.0;
    }
    return ms;
}

OctreeBuilder::OctreeBuilder(vk::Device& device, const PosedGpuScene& scene, const GridTile& tile,
                             const BuildOptions& options)
    : m_device(device), m_scene(scene), m_tile(tile), m_options(options)
{
    const Grid& grid = tile.grid;
    if (grid.depth < 1 || grid.depth > Grid::kDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a grid of depth {} is out of range: 1 to {} (resolution 2 to {})",
                                                  grid.depth, Grid::kDepthMax, 1U << Grid::kDepthMax));
    }
    const std::uint32_t tiles = tile.depth <= grid.depth ? 1U << (grid.depth - tile.depth) : 0;
    if (tiles > GridTile::kTilesMax || glm::any(glm::greaterThanEqual(tile.index, glm::uvec3(tiles))))
    {
        throw Error(ErrorCode::Usage, fmt::format("a grid of depth {} has no tile ({}, {}, {}) of depth {}", grid.depth,
                                                  tile.index.x, tile.index.y, tile.index.z, tile.depth));
    }
    if (options.attributes && !scene.uploaded().has_attributes)
    {
        throw Error(ErrorCode::Usage, "attributes were asked of a scene that was uploaded without them");
    }
    m_step = {&OctreeBuilder::cover, &OctreeBuilder::learnCoverage};
    m_readback = {device, kReadbackBytes};
    m_result.octree.grid = grid;
    m_row_shape = options.row_shape.value_or(RowShape::on(device));
    m_sum_form = options.sum_form.value_or(SumForm::on(device));
    const bool emits = scene.uploaded().emission_scale > 0.0F;
    m_sum_form.mixed = m_sum_form.mixed && options.attributes && !options.keep_sums && !emits &&
                       (options.sum_form || hasLargeTriangles(scene.uploaded(), grid));
    m_result.capacities =
        usable(options.capacities.value_or(VoxelizeCapacities::estimate(scene.uploaded(), grid, m_row_shape)));
    const std::uint32_t tuned = tunedValue(device, Tunable::VoxelForm);
    const bool by_bricks = options.by_bricks.value_or(
        tuned == kVoxelsByBricks || (tuned == kVoxelsAuto && hasLargeTriangles(scene.uploaded(), grid)));
    const bool shares_capacities = options.capacities && tile.depth < grid.depth; // with the other tiles of a grid
    if (by_bricks && options.attributes && !options.keep_sums && !shares_capacities &&
        suitsBricks(scene.uploaded(), grid, options.coverage))
    {
        m_brick_capacities = BrickCapacities::estimate(scene.uploaded(), grid);
        if (haveRoom(m_brick_capacities, m_sum_form.mixed, device))
        {
            m_step = {&OctreeBuilder::coverByBricks, &OctreeBuilder::learnBricks};
        }
    }
}

VoxelizeJob OctreeBuilder::voxelizeJob()
{
    return {.scene = m_scene, .tile = m_tile, .coverage = m_options.coverage, .buffers = m_coverings->voxelize};
}

void OctreeBuilder::cover(vk::FrameGraph& graph)
{
    const GpuScene& scene = m_scene.uploaded();
    if (!m_coverings)
    {
        m_device.memory().require(coverageBytes(m_result.capacities, scene, m_sum_form.mixed), "voxelization");
        m_coverings.emplace(Coverings{{m_device, m_result.capacities, scene, m_row_shape, m_sum_form},
                                      {m_device, m_result.capacities.bricks}});
    }
    voxelizeCoverage(graph, voxelizeJob());
    listNodes(graph, m_tile.grid, m_coverings->voxelize, m_coverings->work);
    m_offsets.counters = m_readback.copy(graph, m_coverings->voxelize.counters, 0, 1);
    m_offsets.ranges = m_readback.copy(graph, m_coverings->work.ranges, 0, m_tile.grid.nodeLevels());
    m_offsets.rasters.clear();
    for (const VoxelizeBuffers::RowWork& rows : m_coverings->voxelize.rows)
    {
        if (rows.counters.count() != 0)
        {
            m_offsets.rasters.push_back(m_readback.copy(graph, rows.counters, 0, 1));
        }
    }
}

// Repeats the coverage step with larger buffers if something had no room.
void OctreeBuilder::learnCoverage()
{
    const gpu::BrickCounters counters = m_readback.at<gpu::BrickCounters>(m_offsets.counters, 1).front();
    std::vector<gpu::RasterCounters> rasters;
    for (const std::uint64_t offset : m_offsets.rasters)
    {
        rasters.push_back(m_readback.at<gpu::RasterCounters>(offset, 1).front());
    }
    if (const std::optional<Growth> growth = growthOf(m_result.capacities, counters, rasters))
    {
        grow(*growth);
        ++m_result.retry_count;
        return;
    }
    if (counters.voxel_carry != 0)
    {
        throwTooBig("voxels");
    }
    m_result.dropped = droppedTriangles(rasters);
    allocateNodes(counters);
    if (!m_options.attributes)
    {
        m_coverings->voxelize.rows = {};
    }
    if (m_result.octree.node_count == 0)
    {
        end();
        return;
    }
    m_step = {&OctreeBuilder::number, &OctreeBuilder::endNumbers};
}

void OctreeBuilder::requireRetry() const
{
    if (m_result.retry_count + 1 >= kRetriesMax)
    {
        throw Error(ErrorCode::Memory,
                    fmt::format("voxelization found no room in {} attempts; lower the resolution", kRetriesMax));
    }
}

void OctreeBuilder::grow(const Growth& growth)
{
    m_coverings.reset();
    requireRetry();
    // The likely one: fewer runs, where memory allows it.
    const bool fits =
        coverageBytes(growth.likely, m_scene.uploaded(), m_sum_form.mixed) <= m_device.memory().roomBytes();
    m_result.capacities = fits ? growth.likely : growth.needed;
}

// Allocates the nodes of the octree, whose number is that of the node list.
void OctreeBuilder::allocateNodes(const gpu::BrickCounters& counters)
{
    requireIndexable(counters.node_count, m_options.attributes ? counters.voxel_count : 0);
    DeviceTree& octree = m_result.octree;
    octree.node_count = counters.node_count;
    octree.voxel_count = counters.voxel_count;
    m_mixed_count = counters.mixed_count;
    if (octree.node_count == 0)
    {
        return;
    }
    addLevels(octree.grid.nodeLevels());
    octree.nodes = {m_device, "octree/nodes", octree.node_count};
}

// Adds the levels of the node list, of which there are `count`, to the octree. Returns the number of their nodes.
std::uint32_t OctreeBuilder::addLevels(std::uint32_t count)
{
    const auto listed = m_readback.at<gpu::LevelRange>(m_offsets.ranges, count);
    std::uint32_t first_node = 0; // the list ends with the root, with which the octree starts
    for (auto range = listed.rbegin(); range != listed.rend(); ++range)
    {
        m_result.octree.levels.push_back({first_node, range->count});
        first_node += range->count;
    }
    return first_node;
}

void OctreeBuilder::number(vk::FrameGraph& graph)
{
    numberNodes(graph, m_coverings->voxelize.bricks, m_coverings->work, m_result.octree, m_result.octree.levels.size());
}

void OctreeBuilder::endNumbers()
{
    if (!m_sum_form.mixed)
    {
        m_coverings->work.items = {};
    }
    m_coverings->work.partials = {};
    if (!m_options.attributes)
    {
        m_coverings.reset();
        m_step = {&OctreeBuilder::addLeafWords, &OctreeBuilder::end};
        return;
    }
    m_step = {&OctreeBuilder::attributes, &OctreeBuilder::learnAttributes};
}

void OctreeBuilder::attributes(vk::FrameGraph& graph)
{
    DeviceTree& octree = m_result.octree;
    const bool emits = m_scene.uploaded().emission_scale > 0.0F;
    if (!m_sums)
    {
        const std::uint64_t word_count = emits ? divideUp(octree.voxel_count, gpu::kVoxelsPerEmissionWord) : 0;
        const std::uint32_t sum_count = m_sum_form.mixed ? m_mixed_count : octree.voxel_count;
        m_device.memory().require(octree.voxel_count * sizeof(gpu::Attribute) + sum_count * sizeof(gpu::VoxelSums) +
                                      word_count * sizeof(gpu::uvec2),
                                  "averaging the attributes");
        vk::BufferOf<gpu::Attribute> voxel_attributes(m_device, "octree/voxel_attributes", octree.voxel_count);
        vk::BufferOf<gpu::uvec2> emission_words(m_device, "octree/emission_words", word_count);
        m_sums.emplace(m_device, octree.voxel_count, sum_count, emits);
        octree.voxel_attributes = std::move(voxel_attributes); // all or nothing: the step may come again
        octree.emission_words = std::move(emission_words);
    }
    voxelizeAttributes(graph, voxelizeJob(), m_coverings->work.items, *m_sums, octree);
    m_offsets.max_fragments = m_readback.copy(graph, m_sums->max_fragments, 0, 1);
    if (emits)
    {
        m_offsets.emissive_count = m_readback.copy(graph, m_sums->emissive_count, 0, 1);
    }
}

// Repeats the attributes with fewer value bits if the fragments of a voxel had no room in its sums.
void OctreeBuilder::learnAttributes()
{
    const gpu::uint fragments = m_readback.at<gpu::uint>(m_offsets.max_fragments, 1).front();
    if (fragments != 0) // drop as many value bits as the largest sum has too many
    {
        m_sums->sum_shift = static_cast<std::uint32_t>(std::bit_width(fragments / (gpu::kFragmentsMax + 1)));
        ++m_result.retry_count;
        return;
    }
    const float emission_scale = m_scene.uploaded().emission_scale;
    if (emission_scale > 0.0F)
    {
        m_result.octree.emission_scale = emission_scale;
        m_emissive_count = m_readback.at<gpu::uint>(m_offsets.emissive_count, 1).front();
        if (m_emissive_count != 0)
        {
            m_step = {&OctreeBuilder::emission, &OctreeBuilder::endVoxelAttributes};
            return;
        }
        m_result.octree.emission_words = {};
    }
    endVoxelAttributes();
}

void OctreeBuilder::emission(vk::FrameGraph& graph)
{
    if (m_result.octree.emission.count() == 0)
    {
        decltype(m_sums->emission_sums) emission_sums(m_device, "voxelize/emission_sums", m_emissive_count);
        m_result.octree.emission = {m_device, "octree/emission", m_emissive_count};
        m_sums->emission_sums = std::move(emission_sums);
    }
    voxelizeEmission(graph, voxelizeJob(), *m_sums, m_result.octree);
}

// The sums are many times larger than what becomes of them: they and the brick table go before the attributes of inner
// nodes come.
void OctreeBuilder::endVoxelAttributes()
{
    m_coverings.reset();
    m_bricks.reset();
    if (m_options.keep_sums)
    {
        m_result.octree.sums = {std::move(m_sums->sums), std::move(m_sums->emission_sums), m_sums->sum_shift};
    }
    m_sums.reset();
    m_step = {&OctreeBuilder::average, &OctreeBuilder::end};
}

void OctreeBuilder::average(vk::FrameGraph& graph)
{
    DeviceTree& octree = m_result.octree;
    if (octree.node_attributes.count() == 0)
    {
        octree.node_attributes = {m_device, "octree/node_attributes", octree.node_count};
    }
    averageNodes(graph, m_scene.uploaded(), octree);
    addLeafWords(graph);
}

// While it is made, an octree's leaves are nodes, which tell the fragments where their voxels are.
void OctreeBuilder::addLeafWords(vk::FrameGraph& graph)
{
    DeviceTree& octree = m_result.octree;
    const std::uint32_t leaf_words = leafWordsOf(octree.levels);
    if (leaf_words == 0)
    {
        return;
    }
    if (m_pool.count() == 0)
    {
        const std::uint64_t pool_nodes =
            divideUp(std::uint64_t{2} * octree.node_count - leaf_words, ListPacking::kWordsOfNode);
        const std::uint64_t group_count =
            1 + divideUp(std::uint64_t{2} * octree.node_count - leaf_words, gpu::kLeafGroup);
        m_device.memory().require(pool_nodes * sizeof(gpu::Node) + group_count * sizeof(gpu::uvec2), "the leaves");
        octree.leaf_groups = {m_device, "octree/leaf_groups", group_count};
        m_pool = {m_device, octree.nodes.name(), pool_nodes};
    }
    makeLeafWords(graph, octree, m_pool, octree.leaf_groups);
}

void OctreeBuilder::coverByBricks(vk::FrameGraph& graph)
{
    if (!m_bricks)
    {
        m_device.memory().require(m_brick_capacities.bytes(m_sum_form.mixed), "voxelization");
        m_bricks.emplace(
            Bricks{{m_device, m_brick_capacities, m_sum_form.mixed}, {m_device, m_brick_capacities.entries}});
    }
    coverBricks(graph, {m_scene, m_tile, m_bricks->bricks});
    listBricks(graph, m_tile.grid, m_bricks->bricks, m_bricks->work);
    m_offsets.bins = m_readback.copy(graph, m_bricks->bricks.counters, 0, 1);
    m_offsets.counters = m_readback.copy(graph, m_bricks->bricks.nodes, 0, 1);
    m_offsets.ranges = m_readback.copy(graph, m_bricks->work.ranges, 0, m_tile.grid.nodeLevels() - 1);
}

// Repeats the step with larger buffers if something had no room. What is too large for bricks goes by triangles.
void OctreeBuilder::learnBricks()
{
    const gpu::BinCounters bins = m_readback.at<gpu::BinCounters>(m_offsets.bins, 1).front();
    const gpu::BrickCounters nodes = m_readback.at<gpu::BrickCounters>(m_offsets.counters, 1).front();
    const BrickCapacities grown = grownFor(bins, nodes, m_brick_capacities);
    if (areBeyondBricks(bins) || grown != m_brick_capacities)
    {
        m_bricks.reset();
        requireRetry();
        if (areBeyondBricks(bins) || !haveRoom(grown, m_sum_form.mixed, m_device))
        {
            m_step = {&OctreeBuilder::cover, &OctreeBuilder::learnCoverage};
        }
        m_brick_capacities = grown;
        ++m_result.retry_count;
        return;
    }
    if (bins.voxel_carry != 0)
    {
        throwTooBig("voxels");
    }
    gpu::RasterCounters dropped{};
    dropped.nonfinite = bins.nonfinite;
    dropped.out_of_range = bins.out_of_range;
    dropped.outside = bins.outside;
    dropped.zero_area = bins.zero_area;
    m_result.dropped = droppedTriangles({dropped});
    requireIndexable(nodes.node_count + bins.leaf_count, bins.voxel_count);
    DeviceTree& octree = m_result.octree;
    octree.node_count = nodes.node_count + bins.leaf_count;
    octree.voxel_count = bins.voxel_count;
    if (octree.node_count == 0)
    {
        end();
        return;
    }
    const std::uint32_t first_leaf = addLevels(octree.grid.nodeLevels() - 1);
    octree.levels.push_back({first_leaf, bins.leaf_count});
    octree.nodes = {m_device, "octree/nodes", octree.node_count};
    m_item_count = bins.item_count;
    m_mixed_count = bins.mixed_count;
    m_step = {&OctreeBuilder::numberBricks, &OctreeBuilder::endBrickNumbers};
}

void OctreeBuilder::numberBricks(vk::FrameGraph& graph)
{
    const std::uint32_t leaf_count = m_result.octree.levels.back().node_count;
    if (m_sum_form.mixed && m_bricks->bricks.mixed.count() == 0)
    {
        m_device.memory().require(leaf_count * sizeof(gpu::MixedVoxels), "the leaves of bricks");
        m_bricks->bricks.mixed = {m_device, "voxelize/mixed_voxels", leaf_count};
    }
    prepareLeaves(m_device, m_tile.grid, m_bricks->bricks);
    numberNodes(graph, m_bricks->bricks.table, m_bricks->work, m_result.octree, m_result.octree.levels.size() - 1);
    placeLeaves(graph, m_tile.grid, m_bricks->bricks, m_bricks->work.items, m_result.octree);
}

void OctreeBuilder::endBrickNumbers()
{
    BrickBuffers& bricks = m_bricks->bricks;
    bricks.masks = {};
    bricks.ranges = {};
    bricks.order = {};
    bricks.work_bricks = {};
    bricks.large = {};
    m_bricks->work.items = {};
    m_step = {&OctreeBuilder::brickAttributes, &OctreeBuilder::learnAttributes};
}

void OctreeBuilder::brickAttributes(vk::FrameGraph& graph)
{
    DeviceTree& octree = m_result.octree;
    if (!m_sums)
    {
        const std::uint32_t sum_count = m_sum_form.mixed ? m_mixed_count : octree.voxel_count;
        m_device.memory().require(octree.voxel_count * sizeof(gpu::Attribute) + sum_count * sizeof(gpu::VoxelSums),
                                  "averaging the attributes");
        vk::BufferOf<gpu::Attribute> voxel_attributes(m_device, "octree/voxel_attributes", octree.voxel_count);
        m_sums.emplace(m_device, octree.voxel_count, sum_count, false);
        octree.voxel_attributes = std::move(voxel_attributes);
    }
    shadeBricks(graph, {m_scene, m_tile, m_bricks->bricks}, m_item_count, m_sum_form.int64, *m_sums, octree);
    m_offsets.max_fragments = m_readback.copy(graph, m_sums->max_fragments, 0, 1);
}

void OctreeBuilder::end()
{
    m_bricks.reset();
    m_coverings.reset();
    if (m_pool.count() != 0)
    {
        m_result.octree.nodes = std::move(m_pool);
        m_result.octree.leaf_words = m_result.octree.levels.back().node_count;
    }
    finish();
}

} // namespace zvo
