// SPDX-License-Identifier: MIT
#include "core/pipeline.h"

#include "core/divide_up.h"
#include "core/octree_build.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <variant>

namespace zvo
{

namespace
{

constexpr std::uint32_t kRetriesMax = 32; // a table of one brick grows to the largest in half of them

void append(std::vector<vk::PassTime>& passes, std::vector<vk::PassTime>&& more)
{
    passes.insert(passes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

[[noreturn]] void throwTooBig(const char* what)
{
    throw Error(ErrorCode::Memory,
                fmt::format("the scene makes more {} than 32-bit numbers count; lower the resolution, "
                            "or split the scene",
                            what));
}

// Bytes of everything that coverVoxels allocates.
std::uint64_t coverageBytes(const VoxelizeCapacities& capacities, const GpuScene& scene)
{
    std::uint64_t bytes = capacities.bricks * (sizeof(gpu::BrickEntry) + sizeof(gpu::WorkItem)) +
                          divideUp(capacities.bricks, gpu::kScanBlock) * sizeof(gpu::uint);
    for (const vk::BufferOf<gpu::Chunk>& chunks : scene.chunks)
    {
        if (chunks.count() != 0)
        {
            bytes +=
                capacities.big_triangles * sizeof(gpu::BigTriangle) + capacities.row_blocks * sizeof(gpu::RowBlock);
        }
    }
    return bytes;
}

// Whatever was asked for, a table of a power of two.
VoxelizeCapacities usable(VoxelizeCapacities capacities)
{
    constexpr std::uint64_t kListMax = UINT32_MAX; // kernels count in 32 bits
    capacities.bricks = std::bit_ceil(std::clamp<std::uint64_t>(capacities.bricks, 1, VoxelizeCapacities::kBricksMax));
    capacities.big_triangles = std::min(capacities.big_triangles, kListMax);
    capacities.row_blocks = std::min(capacities.row_blocks, kListMax);
    return capacities;
}

// What a run showed to be too small.
struct Growth
{
    VoxelizeCapacities needed; // what is known to be: maybe still too little
    VoxelizeCapacities likely; // what will suffice, as far as the run tells
};

// Row blocks of all bands, if those that found no room have as many each as the others, and an eighth more.
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

// Nothing when everything sufficed.
std::optional<Growth> growthOf(const VoxelizeCapacities& tried, const gpu::BrickCounters& bricks,
                               const std::vector<gpu::RasterCounters>& rasters)
{
    Growth growth = {tried, tried};
    bool grown = false;
    if (bricks.overflow_count != 0)
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

// The brick table with its node list.
struct Coverings
{
    VoxelizeBuffers voxelize;
    OctreeBuildBuffers work;
    gpu::BrickCounters counters{};
};

// The coverings, with what result tells of them, or what was too small.
std::variant<Coverings, Growth> tryToCover(vk::HeadlessDevice& device, const PlacedScene& scene, const GridTile& tile,
                                           Coverage coverage, BuildResult& result)
{
    device.device().memory().require(coverageBytes(result.capacities, scene.uploaded()), "voxelization");
    Coverings coverings{{device.device(), result.capacities, scene.uploaded()},
                        {device.device(), result.capacities.bricks}};
    std::vector<vk::PassTime> passes = device.run(
        [&](vk::FrameGraph& graph)
        {
            voxelizeCoverage(graph, scene, tile, coverage, coverings.voxelize);
            listNodes(graph, tile.grid, coverings.voxelize, coverings.work);
        });
    coverings.counters = device.download(coverings.voxelize.counters).front();
    std::vector<gpu::RasterCounters> rasters;
    for (const VoxelizeBuffers::RowWork& rows : coverings.voxelize.rows)
    {
        if (rows.counters.count() != 0)
        {
            rasters.push_back(device.download(rows.counters).front());
        }
    }
    if (const std::optional<Growth> growth = growthOf(result.capacities, coverings.counters, rasters))
    {
        return *growth;
    }
    if (coverings.counters.voxel_carry != 0)
    {
        throwTooBig("voxels");
    }
    result.dropped = droppedTriangles(rasters);
    append(result.passes, std::move(passes));
    return coverings;
}

Coverings coverVoxels(vk::HeadlessDevice& device, const PlacedScene& scene, const GridTile& tile, Coverage coverage,
                      BuildResult& result)
{
    for (; result.retry_count < kRetriesMax; ++result.retry_count)
    {
        std::variant<Coverings, Growth> outcome = tryToCover(device, scene, tile, coverage, result);
        if (auto* coverings = std::get_if<Coverings>(&outcome))
        {
            return std::move(*coverings);
        }
        const Growth& growth = std::get<Growth>(outcome); // the likely one: fewer runs, where memory allows it
        const bool fits = coverageBytes(growth.likely, scene.uploaded()) <= device.device().memory().roomBytes();
        result.capacities = fits ? growth.likely : growth.needed;
    }
    throw Error(ErrorCode::Memory,
                fmt::format("voxelization found no room in {} attempts (last: a table of {} bricks); "
                            "lower the resolution",
                            kRetriesMax, result.capacities.bricks));
}

// Sizes octree from the node list.
void allocateNodes(vk::HeadlessDevice& device, const Coverings& coverings, Octree& octree)
{
    octree.node_count = coverings.counters.node_count;
    octree.voxel_count = coverings.counters.voxel_count;
    if (octree.node_count == 0)
    {
        return;
    }
    std::vector<gpu::LevelRange> ranges = device.download(coverings.work.ranges, 0, octree.grid.nodeLevels());
    std::reverse(ranges.begin(), ranges.end()); // the list starts with the leaves, the octree with the root
    std::uint32_t first_node = 0;
    for (const gpu::LevelRange& range : ranges)
    {
        octree.levels.push_back({first_node, range.count});
        first_node += range.count;
    }
    octree.nodes = {device.device(), "octree/nodes", octree.node_count};
}

void makeEmission(vk::HeadlessDevice& device, const PlacedScene& scene, const GridTile& tile, Coverage coverage,
                  VoxelizeBuffers& voxelize, AttributeBuffers& attributes, BuildResult& result)
{
    Octree& octree = result.octree;
    octree.emission_scale = scene.uploaded().emission_scale;
    const std::uint32_t emissive_count = device.download(attributes.emissive_count).front();
    if (emissive_count == 0)
    {
        octree.emission_words = {};
        return;
    }
    attributes.emission_sums = {device.device(), "voxelize/emission_sums", emissive_count};
    octree.emission = {device.device(), "octree/emission", emissive_count};
    append(result.passes,
           device.run([&](vk::FrameGraph& graph)
                      { voxelizeEmission(graph, scene, tile, coverage, voxelize, attributes, octree); }));
}

// Voxel attributes, and emission; voxelize is used up. The sums are many times larger than what becomes of them: they
// and the brick table go before the attributes of inner nodes come.
void makeVoxelAttributes(vk::HeadlessDevice& device, const PlacedScene& scene, const GridTile& tile,
                         const BuildOptions& options, VoxelizeBuffers& voxelize, BuildResult& result)
{
    const Coverage coverage = options.coverage;
    Octree& octree = result.octree;
    const bool emission = scene.uploaded().emission_scale > 0.0F;
    const std::uint64_t word_count = emission ? divideUp(octree.voxel_count, 32) : 0;
    device.device().memory().require(octree.voxel_count * (sizeof(gpu::Attribute) + sizeof(gpu::VoxelSums)) +
                                         word_count * sizeof(gpu::uvec2),
                                     "averaging the attributes");
    octree.voxel_attributes = {device.device(), "octree/voxel_attributes", octree.voxel_count};
    octree.emission_words = {device.device(), "octree/emission_words", word_count};
    AttributeBuffers attributes(device.device(), octree.voxel_count, emission);
    for (bool too_many = true; too_many;)
    {
        std::vector<vk::PassTime> passes =
            device.run([&](vk::FrameGraph& graph)
                       { voxelizeAttributes(graph, scene, tile, coverage, voxelize, attributes, octree); });
        const std::uint32_t fragments = device.download(attributes.max_fragments).front();
        too_many = fragments != 0;
        if (too_many) // drop as many value bits as the largest sum has too many
        {
            attributes.sum_shift = static_cast<std::uint32_t>(std::bit_width(fragments / (gpu::kFragmentsMax + 1)));
            ++result.retry_count;
        }
        else
        {
            append(result.passes, std::move(passes));
        }
    }
    if (emission)
    {
        makeEmission(device, scene, tile, coverage, voxelize, attributes, result);
    }
    voxelize.bricks = {};
    voxelize.rows = {};
    if (options.keep_sums)
    {
        result.sums = {std::move(attributes.sums), std::move(attributes.emission_sums), attributes.sum_shift};
    }
}

void makeNodeAttributes(vk::HeadlessDevice& device, const GpuScene& scene, BuildResult& result)
{
    Octree& octree = result.octree;
    octree.node_attributes = {device.device(), "octree/node_attributes", octree.node_count};
    append(result.passes, device.run([&](vk::FrameGraph& graph) { averageNodes(graph, scene, octree); }));
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

BuildResult buildOctree(vk::HeadlessDevice& device, const PlacedScene& scene, const GridTile& tile,
                        const BuildOptions& options)
{
    const Grid& grid = tile.grid;
    if (grid.depth < 1 || grid.depth > Grid::kDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a grid of depth {} is out of range: 1 to {} (resolution 2 to {})",
                                                  grid.depth, Grid::kDepthMax, 1U << Grid::kDepthMax));
    }
    const std::uint32_t places = tile.depth <= grid.depth ? 1U << (grid.depth - tile.depth) : 0;
    if (places > GridTile::kPlacesMax || glm::any(glm::greaterThanEqual(tile.place, glm::uvec3(places))))
    {
        throw Error(ErrorCode::Usage, fmt::format("a grid of depth {} has no tile ({}, {}, {}) of depth {}", grid.depth,
                                                  tile.place.x, tile.place.y, tile.place.z, tile.depth));
    }
    if (options.attributes && !scene.uploaded().has_attributes)
    {
        throw Error(ErrorCode::Usage, "attributes were asked of a scene that was uploaded without them");
    }
    BuildResult result;
    result.octree.grid = grid;
    result.capacities = usable(options.capacities.value_or(VoxelizeCapacities::estimate(scene.uploaded(), grid)));
    Coverings coverings = coverVoxels(device, scene, tile, options.coverage, result);
    if (!options.attributes)
    {
        coverings.voxelize.rows = {};
    }
    allocateNodes(device, coverings, result.octree);
    if (result.octree.node_count == 0)
    {
        return result;
    }
    append(result.passes, device.run([&](vk::FrameGraph& graph)
                                     { numberNodes(graph, coverings.voxelize, coverings.work, result.octree); }));
    coverings.work.items = {};
    coverings.work.partials = {};
    if (options.attributes)
    {
        makeVoxelAttributes(device, scene, tile, options, coverings.voxelize, result);
        makeNodeAttributes(device, scene.uploaded(), result);
    }
    return result;
}

std::vector<std::uint64_t> voxelCodes(vk::HeadlessDevice& device, const Octree& octree)
{
    const std::vector<gpu::Node> nodes = device.download(octree.nodes);
    std::vector<std::uint64_t> codes = {0}; // of the nodes of a level, in their order
    for (const Octree::Level& level : octree.levels)
    {
        std::vector<std::uint64_t> children;
        for (std::uint32_t i = 0; i < level.node_count; ++i)
        {
            const gpu::Node& node = nodes[level.first_node + i];
            const std::uint64_t mask = node.mask_lo | std::uint64_t{node.mask_hi} << 32;
            for (std::uint64_t rest = mask; rest != 0; rest &= rest - 1)
            {
                children.push_back(codes[i] << 6 | static_cast<std::uint64_t>(std::countr_zero(rest)));
            }
        }
        codes = std::move(children);
    }
    return octree.levels.empty() ? std::vector<std::uint64_t>{} : codes;
}

} // namespace zvo
