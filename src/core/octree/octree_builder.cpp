// SPDX-License-Identifier: MIT
#include "core/octree/octree_builder.h"

#include "core/base/divide_up.h"
#include "core/base/tuning.h"
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

constexpr std::uint32_t kFilledDepthMin = 3; // a filled tree has leaf words

// In deeper grids a thread that walks a whole column of bricks twice would need more iterations than software devices
// give it.
constexpr std::uint32_t kRobustDepthMax = 15;

constexpr std::uint32_t kRetriesMax = 32; // a table of one brick grows to the largest in half of them

// Rounds the table's capacity up to a power of two, whatever was asked for.
VoxelizeCapacities usable(VoxelizeCapacities capacities)
{
    capacities.table = std::bit_ceil(std::clamp<std::uint64_t>(capacities.table, 1, VoxelizeCapacities::kTableMax));
    for (std::uint64_t* count : {&capacities.bricks, &capacities.setups, &capacities.items, &capacities.large})
    {
        *count = std::clamp<std::uint64_t>(*count, 1, kIndicesMax);
    }
    return capacities;
}

// Whether the scene's triangles have voxels of their own. In a dense mesh nearly all voxels are mixed, and telling them
// from others gains nothing.
bool hasLargeTriangles(const GpuScene& scene, const Grid& grid)
{
    constexpr double kVoxelsOfTriangle = 2;
    const double voxel = grid.voxel_size;
    return scene.surface_area >= kVoxelsOfTriangle * voxel * voxel * static_cast<double>(scene.triangle_count);
}

// Voxels that a robust fill has left undecided, in bricks and as whole nodes.
std::uint64_t undecidedVoxels(const BrickCounts& counts)
{
    std::uint64_t voxels = counts.bins.undecided_lo + (std::uint64_t{counts.bins.undecided_hi} << 32);
    for (std::uint32_t height = 0; height < counts.listed.size(); ++height)
    {
        voxels += std::uint64_t{counts.nodes.undecided[height]} << (kCellBits * (height + 2)); // a brick: 2 levels
    }
    return voxels;
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
    if (options.fill != Fill::None && (grid.depth < kFilledDepthMin || tile.depth != grid.depth))
    {
        throw Error(ErrorCode::Usage, "only whole grids with a resolution of 8 or more can be filled");
    }
    if (options.fill == Fill::Robust && grid.depth > kRobustDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("only grids with a resolution of up to {} are filled as robust",
                                                  1U << kRobustDepthMax));
    }
    if (options.shell == Shell::None && (options.fill == Fill::None || options.fill == Fill::Robust))
    {
        throw Error(ErrorCode::Usage, "the shell can be left out only of what is filled as solid or by parity");
    }
    m_step = {&OctreeBuilder::cover, &OctreeBuilder::learnCoverage};
    m_readback = {device, kBrickReadbackBytes};
    m_result.octree.grid = grid;
    const GpuScene& uploaded = scene.uploaded();
    const SumForm sums = options.sum_form.value_or(SumForm::on(device));
    m_int64 = sums.int64;
    m_form.coverage = options.coverage;
    m_form.attributes = options.attributes;
    m_form.fill = options.fill;
    m_form.shell = options.shell;
    m_form.emission = options.attributes && uploaded.emission_scale > 0.0F;
    m_form.mixed = sums.mixed && options.attributes && !options.keep_sums && !m_form.emission &&
                   (options.sum_form || hasLargeTriangles(uploaded, grid));
    m_result.capacities =
        usable(options.capacities.value_or(VoxelizeCapacities::estimate(uploaded, grid, options.coverage)));
}

VoxelizeJob OctreeBuilder::voxelizeJob()
{
    return {.scene = m_scene, .tile = m_tile, .buffers = m_bricks->voxelize};
}

void OctreeBuilder::cover(vk::FrameGraph& graph)
{
    if (!m_bricks)
    {
        const VoxelizeCapacities& capacities = m_result.capacities;
        m_device.memory().require(capacities.bytes(m_scene.uploaded(), m_form) +
                                      OctreeBuildBuffers::bytes(capacities.table, capacities.bricks),
                                  "voxelization");
        m_bricks.emplace(OctreeBricks{
            {m_device, capacities, m_scene.uploaded(), m_form}, {m_device, capacities.table, capacities.bricks}, {}});
    }
    voxelizeCoverage(graph, voxelizeJob());
    listNodes(graph, m_tile, m_bricks->voxelize, m_bricks->work);
    listFullNodes(graph, m_tile, m_bricks->voxelize, m_bricks->work);
    m_offsets.counts = copyCounts(graph, m_readback, *m_bricks, m_tile.grid.nodeLevels());
}

// Repeats the coverage step with larger buffers if something had no room.
void OctreeBuilder::learnCoverage()
{
    const BrickCounts counts = readCounts(m_readback, m_offsets.counts, m_tile.grid.nodeLevels());
    const gpu::BinCounters& bins = counts.bins;
    gpu::BinCounters counters = bins;
    counters.overflow_count += counts.nodes.overflow_count;
    const VoxelizeCapacities grown = m_result.capacities.grownFor(counters);
    if (grown != m_result.capacities)
    {
        grow(grown);
        ++m_result.retry_count;
        return;
    }
    if (bins.voxel_carry != 0)
    {
        throwUncountable("voxels");
    }
    m_result.dropped = droppedTriangles(bins);
    m_result.open.lines = bins.open_lines;
    m_item_count = bins.item_count;
    m_mixed_count = bins.mixed_count;
    allocateNodes(m_device, counts, *m_bricks, m_result.octree);
    if (m_form.fill == Fill::Robust)
    {
        m_result.open.undecided = undecidedVoxels(counts);
    }
    if (m_result.octree.node_count == 0)
    {
        end();
        return;
    }
    m_step = {&OctreeBuilder::number, &OctreeBuilder::endNumbers};
}

void OctreeBuilder::grow(const VoxelizeCapacities& grown)
{
    m_bricks.reset();
    if (m_result.retry_count + 1 >= kRetriesMax)
    {
        throw Error(ErrorCode::Memory,
                    fmt::format("voxelization found no room in {} attempts; lower the resolution", kRetriesMax));
    }
    m_result.capacities = grown;
}

void OctreeBuilder::number(vk::FrameGraph& graph)
{
    numberBricks(graph, *m_bricks, m_result.octree);
}

void OctreeBuilder::endNumbers()
{
    m_occupied = std::move(m_bricks->leaves.occupied);
    if (!m_form.attributes)
    {
        m_bricks.reset();
        m_step = {&OctreeBuilder::leafWords, &OctreeBuilder::end};
        return;
    }
    VoxelizeBuffers& voxelize = m_bricks->voxelize;
    voxelize.masks = {};
    voxelize.crossings = {};
    voxelize.ranges = {};
    voxelize.large = {};
    m_bricks->work.items = {};
    m_bricks->work.bricks = {};
    m_bricks->work.order = {};
    m_step = {&OctreeBuilder::attributes, &OctreeBuilder::learnAttributes};
}

void OctreeBuilder::attributes(vk::FrameGraph& graph)
{
    DeviceTree& octree = m_result.octree;
    if (!m_sums)
    {
        const std::uint64_t word_count =
            m_form.emission ? divideUp(octree.voxel_count, gpu::kVoxelsPerEmissionWord) : 0;
        const std::uint32_t sum_count = m_form.mixed ? m_mixed_count : octree.voxel_count;
        m_device.memory().require(octree.voxel_count * sizeof(gpu::Attribute) + sum_count * sizeof(gpu::VoxelSums) +
                                      word_count * sizeof(gpu::uvec2),
                                  "averaging the attributes");
        vk::BufferOf<gpu::Attribute> voxel_attributes(m_device, "octree/voxel_attributes", octree.voxel_count);
        vk::BufferOf<gpu::uvec2> emission_words(m_device, "octree/emission_words", word_count);
        m_sums.emplace(m_device, octree.voxel_count, sum_count, m_form.emission);
        octree.voxel_attributes = std::move(voxel_attributes); // all or nothing: the step may come again
        octree.emission_words = std::move(emission_words);
    }
    voxelizeAttributes(graph, voxelizeJob(), m_item_count, m_int64, m_bricks->leaves.mixed, *m_sums, octree);
    m_offsets.max_fragments = m_readback.copy(graph, m_sums->max_fragments, 0, 1);
    if (m_form.emission)
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
    if (m_form.emission)
    {
        m_result.octree.emission_scale = m_scene.uploaded().emission_scale;
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
    voxelizeEmission(graph, voxelizeJob(), m_item_count, *m_sums, m_result.octree);
}

// The sums are many times larger than what becomes of them: they and the bricks go before the attributes of inner
// nodes come.
void OctreeBuilder::endVoxelAttributes()
{
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
    averageOctree(graph, m_scene.uploaded(), m_form.fill != Fill::None, m_result.octree);
    leafWords(graph);
}

// While it is made, an octree's leaves are nodes, which tell the fragments where their voxels are.
void OctreeBuilder::leafWords(vk::FrameGraph& graph)
{
    addLeafWords(graph, m_occupied, m_result.octree, m_pool);
}

void OctreeBuilder::end()
{
    m_bricks.reset();
    takePool(std::move(m_pool), m_form.fill != Fill::None, m_result.octree);
    m_occupied = {};
    finish();
}

} // namespace zvo
