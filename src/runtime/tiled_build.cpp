// SPDX-License-Identifier: MIT
#include "runtime/tiled_build.h"

#include "core/base/morton.h"
#include "core/tree/tree_limits.h"
#include "runtime/attribute_packer.h"
#include "runtime/svdag_forest.h"
#include "runtime/tile_nodes.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::uint32_t kTileDepthMin = 4; // smaller tiles would take no less memory

template <typename T> void append(std::vector<T>& to, const std::vector<T>& from)
{
    to.insert(to.end(), from.begin(), from.end());
}

// Attributes and emission of a part of the grid, but for the voxels' attributes: those of all parts go to one list,
// since parts come in Morton order.
class PartAttributes
{
public:
    std::uint64_t voxel_count = 0;
    std::uint64_t octree_node_count = 0;         // those above the part included
    std::vector<gpu::Attribute> node_attributes; // [octree_node_count] depth first
    std::vector<std::uint32_t> emissive;         // [ceil(voxel_count / 32)] bits, or fewer with zeros behind
    std::vector<gpu::uint> emission;

    // Adds voxels behind those that there are.
    void appendVoxels(const PartAttributes& more)
    {
        append(emission, more.emission);
        for (std::size_t i = 0; i < more.emissive.size(); ++i)
        {
            addBits(voxel_count + i * gpu::kVoxelsPerEmissionWord, more.emissive[i]);
        }
        voxel_count += more.voxel_count;
    }

private:
    void addBits(std::uint64_t voxel, std::uint32_t bits)
    {
        const std::size_t word = voxel / gpu::kVoxelsPerEmissionWord;
        const std::uint64_t shifted = std::uint64_t{bits} << (voxel % gpu::kVoxelsPerEmissionWord);
        if (shifted == 0)
        {
            return;
        }
        emissive.resize(std::max(emissive.size(), word + 2));
        emissive[word] |= static_cast<std::uint32_t>(shifted);
        emissive[word + 1] |= static_cast<std::uint32_t>(shifted >> gpu::kVoxelsPerEmissionWord);
    }
};

// The DAG of the whole grid in which a part of it is occupied, and the part's attributes.
struct Part
{
    DeviceTree dag; // without attributes
    PartAttributes attributes;
    std::vector<gpu::Attribute> voxel_attributes; // of a part that was just built whole
};

class TiledBuilder
{
public:
    TiledBuilder(vk::HeadlessDevice& device, const PosedGpuScene& scene, const Grid& grid, const TiledOptions& options)
        : m_device(device), m_scene(scene), m_grid(grid), m_options(options), m_voxels(device, options.attributes)
    {
    }

    TiledResult build();

private:
    std::optional<Part> buildPart(std::uint32_t depth, std::uint64_t code);
    std::optional<Part> buildWhole(std::uint32_t depth, std::uint64_t code);
    std::optional<Part> buildTiles(std::uint32_t depth, std::uint64_t code, std::uint32_t tile_depth);
    void finishAttributes(PartAttributes& attributes, TreeData& tree);

    [[nodiscard]] bool hasAttributes() const { return m_options.attributes != AttributeFormat::None; }

    vk::HeadlessDevice& m_device;
    const PosedGpuScene& m_scene;
    Grid m_grid;
    const TiledOptions& m_options;
    AttributePacker m_voxels;                                 // attributes of the parts so far
    std::map<std::uint32_t, VoxelizeCapacities> m_capacities; // that sufficed last, by the cube's depth
    TiledResult m_result;
};

// Where to start for a cube of the grid: surfaces that are spread over the grid, and four times as much.
VoxelizeCapacities likelyCapacities(const GpuScene& scene, const Grid& grid, Coverage coverage, std::uint32_t depth)
{
    const VoxelizeCapacities whole = VoxelizeCapacities::estimate(scene, grid, coverage);
    const auto share = [&](std::uint64_t count)
    {
        const std::uint32_t shift = 2 * (grid.depth - depth);
        return std::min(count, std::max<std::uint64_t>(count >> (shift > 2 ? shift - 2 : 0), 1024));
    };
    return {share(whole.table), share(whole.bricks), share(whole.setups), share(whole.items), share(whole.large)};
}

// The largest even depth below that of a cube.
std::uint32_t depthBelow(std::uint32_t depth)
{
    return (depth - 1) / 2 * 2;
}

// A cube of the grid, (1 << depth)^3 voxels. Nothing without voxels.
std::optional<Part> TiledBuilder::buildPart(std::uint32_t depth, std::uint64_t code)
{
    const std::uint32_t tile_depth = std::min(depthBelow(depth), m_options.tile_depth);
    if (depth > m_options.tile_depth)
    {
        return buildTiles(depth, code, tile_depth);
    }
    std::optional<Part> part;
    try
    {
        part = buildWhole(depth, code);
    }
    catch (const Error& error)
    {
        const bool may_split = tile_depth >= kTileDepthMin && (m_grid.depth - tile_depth) < 8;
        if (error.code() != ErrorCode::Memory || !may_split)
        {
            throw;
        }
        m_capacities.erase(depth);
        return buildTiles(depth, code, tile_depth);
    }
    if (part)
    {
        m_voxels.append(std::move(part->voxel_attributes)); // not before all of the part is there
    }
    return part;
}

std::optional<Part> TiledBuilder::buildWhole(std::uint32_t depth, std::uint64_t code)
{
    const auto last = m_capacities.find(depth);
    const VoxelizeCapacities capacities = last != m_capacities.end()
                                              ? last->second
                                              : likelyCapacities(m_scene.uploaded(), m_grid, m_options.coverage, depth);
    BuildResult built = buildOctree(m_device, m_scene, {m_grid, depth, cellOfCode(code)},
                                    {m_options.coverage, hasAttributes(), capacities});
    m_capacities[depth] = built.capacities;
    m_result.dropped = built.dropped;
    m_result.retry_count += built.retry_count;
    append(m_result.passes, built.passes);
    if (built.octree.node_count == 0)
    {
        return std::nullopt;
    }
    CompressResult compressed = compress(m_device, std::move(built.octree));
    m_result.retry_count += compressed.retry_count;
    append(m_result.passes, compressed.passes);
    ++m_result.tile_count;
    Part part;
    DeviceTree& tree = compressed.dag;
    part.voxel_attributes = m_device.download(tree.voxel_attributes);
    part.attributes.voxel_count = tree.voxel_count;
    part.attributes.octree_node_count = tree.octreeNodeCount();
    part.attributes.node_attributes = m_device.download(tree.node_attributes);
    for (const gpu::uvec2& word : m_device.download(tree.emission_words))
    {
        part.attributes.emissive.push_back(word.x);
    }
    part.attributes.emission = m_device.download(tree.emission);
    tree.voxel_attributes = {};
    tree.node_attributes = {};
    tree.emission_words = {};
    tree.emission = {};
    part.dag = std::move(compressed.dag);
    return part;
}

std::optional<Part> TiledBuilder::buildTiles(std::uint32_t depth, std::uint64_t code, std::uint32_t tile_depth)
{
    const std::uint32_t code_bits = 3 * (depth - tile_depth);
    const std::size_t top_levels = m_grid.nodeLevels() - tile_depth / 2;
    SvdagForest forest(m_device, m_grid, tile_depth);
    Part part;
    TileNodes tiles;
    for (std::uint64_t i = 0; i >> code_bits == 0; ++i)
    {
        if (m_options.progress && depth == m_grid.depth)
        {
            m_options.progress(static_cast<double>(i) / static_cast<double>(std::uint64_t{1} << code_bits));
        }
        const std::uint64_t tile = code << code_bits | i;
        std::optional<Part> built = buildPart(tile_depth, tile);
        if (!built)
        {
            continue;
        }
        PartAttributes& attributes = built->attributes;
        tiles.codes.push_back(tile);
        part.attributes.octree_node_count += attributes.octree_node_count - top_levels;
        part.attributes.appendVoxels(attributes);
        if (hasAttributes())
        {
            tiles.roots.push_back(attributes.node_attributes[top_levels]);
            attributes.node_attributes.erase(attributes.node_attributes.begin(),
                                             attributes.node_attributes.begin() +
                                                 static_cast<std::ptrdiff_t>(top_levels));
            tiles.attributes.push_back(std::move(attributes.node_attributes));
        }
        forest.add(tile, std::move(built->dag));
    }
    if (forest.isEmpty())
    {
        return std::nullopt;
    }
    part.attributes.octree_node_count += forest.topNodeCount();
    if (part.attributes.voxel_count > UINT32_MAX || part.attributes.octree_node_count > UINT32_MAX)
    {
        throw Error(ErrorCode::Memory, "the scene makes more voxels than 32-bit numbers count; lower the resolution");
    }
    if (hasAttributes())
    {
        requireIndexable(0, std::max(part.attributes.voxel_count, part.attributes.octree_node_count));
        part.attributes.node_attributes = joinNodes(m_device, m_scene.uploaded(), m_grid, tile_depth, tiles);
    }
    part.dag = forest.finish(hasAttributes() && depth == m_grid.depth);
    append(m_result.passes, forest.passes());
    return part;
}

// Attributes and emission of the whole. What has room on the device is packed there, whichever parts it came in.
void TiledBuilder::finishAttributes(PartAttributes& attributes, TreeData& tree)
{
    AttributePacker nodes(m_device, nodeFormat(m_options.attributes));
    nodes.append(std::move(attributes.node_attributes));
    for (AttributePacker* const packer : {&m_voxels, &nodes})
    {
        packer->finish();
        append(m_result.passes, packer->passes);
    }
    tree.voxel_attributes = std::move(m_voxels.attributes);
    tree.node_attributes = std::move(nodes.attributes);
    if (attributes.voxel_count != 0 && isPacked(m_options.attributes))
    {
        tree.packed = {m_options.attributes, std::move(m_voxels.words), std::move(nodes.words)};
    }
    tree.emission = std::move(attributes.emission);
    if (hasAttributes() && attributes.voxel_count != 0 && m_scene.uploaded().emission_scale > 0)
    {
        tree.emission_scale = m_scene.uploaded().emission_scale;
    }
    if (!tree.emission.empty())
    {
        attributes.emissive.resize((attributes.voxel_count + gpu::kVoxelsPerEmissionWord - 1) /
                                   gpu::kVoxelsPerEmissionWord);
        std::uint32_t rank = 0;
        for (const std::uint32_t bits : attributes.emissive)
        {
            tree.emission_words.push_back({bits, rank});
            rank += static_cast<std::uint32_t>(std::popcount(bits));
        }
    }
}

TiledResult TiledBuilder::build()
{
    std::optional<Part> part = buildPart(m_grid.depth, 0);
    TreeData& tree = m_result.tree;
    if (!part)
    {
        part.emplace();
        part->dag.structure = TreeStructure::Svdag;
        part->dag.grid = m_grid;
    }
    PartAttributes& attributes = part->attributes;
    part->dag.voxel_count = static_cast<std::uint32_t>(attributes.voxel_count);
    part->dag.lists.octree_node_count = static_cast<std::uint32_t>(attributes.octree_node_count);
    tree = downloadTree(m_device, part->dag);
    part->dag = {};
    finishAttributes(attributes, tree);
    return std::move(m_result);
}

} // namespace

TiledResult buildByTiles(vk::HeadlessDevice& device, const PosedGpuScene& scene, const Grid& grid,
                         const TiledOptions& options)
{
    if (options.tile_depth < kTileDepthMin || options.tile_depth % 2 != 0)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("tiles of depth {}: an even number from {} on", options.tile_depth, kTileDepthMin));
    }
    return TiledBuilder(device, scene, grid, options).build();
}

} // namespace zvo
