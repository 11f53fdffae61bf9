// SPDX-License-Identifier: MIT
#include "baseline/thesis_build.h"

#include "core/base/divide_up.h"
#include "core/tree/tree_limits.h"
#include "octree/octree.h"
#include "zvo/error.h"

#include <numeric>
#include <utility>

namespace zvo::baseline
{

namespace
{

// Cells of a level from the first to the last that may be occupied.
struct CellSpan
{
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

std::uint64_t cellsAt(std::uint32_t level)
{
    return std::uint64_t{1} << (3 * level);
}

// The cells of a level above the codes of range. The root is always among them, so that there is a root.
CellSpan spanAt(const Grid& grid, const std::optional<CodeRange>& range, std::uint32_t level)
{
    if (level == 0 || !range)
    {
        return {0, static_cast<std::uint32_t>(cellsAt(level))};
    }
    if (range->first > range->last)
    {
        return {};
    }
    const std::uint32_t shift = 3 * (grid.depth - level);
    return {range->first >> shift, (range->last >> shift) - (range->first >> shift) + 1};
}

// A build, or an update.
struct LevelWork
{
    const ThesisCells& cells;
    const ThesisBuildOptions& options;
    ThesisLevels& levels;
    PointerOctree& octree;
    std::uint32_t root;
    bool merge;
};

// Sets what both kernels of a level have in common.
template <typename Params>
void readChildren(vk::AnyPass& pass, const LevelWork& work, std::uint32_t level, Params& params)
{
    const bool voxels = level + 1 == work.cells.grid.depth;
    const CellSpan children = spanAt(work.cells.grid, work.options.range, level + 1);
    const CellSpan own = spanAt(work.cells.grid, work.options.range, level);
    if (voxels)
    {
        params.voxels = pass.read(work.cells.voxels);
    }
    else
    {
        params.children = pass.read(work.levels.cells[level + 1]);
    }
    params.first_cell = own.first;
    params.cell_count = own.count;
    params.first_child = children.first;
    params.child_count = children.count;
}

void numberTiles(vk::FrameGraph& graph, const LevelWork& work, std::uint32_t level, std::uint64_t cell_count)
{
    {
        vk::Pass pass = graph.addPass(gpu::baseline::ThesisCount{.voxels = level + 1 == work.cells.grid.depth});
        gpu::ThesisCountParams params{};
        readChildren(pass, work, level, params);
        params.partials = pass.write(work.levels.partials);
        pass.dispatch(cell_count, params);
    }
    vk::Pass pass = graph.addPass(gpu::octree::Scan{});
    const gpu::ScanParams params = {pass.readWrite(work.levels.partials),
                                    {pass.readWrite(work.levels.tiles).address + level * sizeof(gpu::uint)},
                                    static_cast<std::uint32_t>(divideUp(cell_count, gpu::kThesisLevelGroup))};
    pass.dispatch(gpu::kScanGroup, params);
}

void makeLevel(vk::FrameGraph& graph, const LevelWork& work, std::uint32_t level)
{
    const std::uint64_t cell_count = spanAt(work.cells.grid, work.options.range, level).count;
    if (cell_count == 0)
    {
        return;
    }
    const bool atomic = work.options.numbering == TileNumbering::Atomic;
    if (!atomic)
    {
        numberTiles(graph, work, level, cell_count);
    }
    vk::Pass pass = graph.addPass(gpu::baseline::ThesisLevel{
        .voxels = level + 1 == work.cells.grid.depth, .atomic = atomic, .merge = work.merge});
    gpu::ThesisLevelParams params{};
    readChildren(pass, work, level, params);
    params.parents = pass.write(work.levels.cells[level]);
    params.nodes = pass.readWrite(work.octree.nodes);
    params.partials = pass.read(work.levels.partials);
    params.tiles = pass.readWrite(work.levels.tiles);
    params.level = level;
    params.depth = work.cells.grid.depth;
    params.root = work.root;
    params.node_capacity = static_cast<std::uint32_t>(work.octree.nodes.count());
    params.static_root = 0;
    pass.dispatch(cell_count, params);
}

void makeLevels(vk::FrameGraph& graph, const LevelWork& work)
{
    graph.fill(work.levels.tiles, 0);
    for (std::uint32_t level = work.cells.grid.depth; level-- > 0;)
    {
        makeLevel(graph, work, level);
    }
}

// Nodes that the last build or update takes, its root among them.
std::uint64_t countNodes(vk::HeadlessDevice& device, const ThesisLevels& levels)
{
    const std::vector<gpu::uint> tiles = device.download(levels.tiles);
    return 1 + gpu::kTileNodes * std::accumulate(tiles.begin(), tiles.end(), std::uint64_t{0});
}

// The number of nodes, which kernels index.
std::uint32_t checkedCount(std::uint64_t nodes)
{
    requireIndexable(nodes, 0);
    return static_cast<std::uint32_t>(nodes);
}

} // namespace

ThesisLevels::ThesisLevels(vk::Device& device, const Grid& grid)
    : tiles(device, "baseline/thesis_tiles", gpu::kThesisLevels)
{
    requireDepth(grid, gpu::kThesisDepthMax, "the thesis's construction, with 8^level dense cells,");
    for (std::uint32_t level = 0; level < grid.depth; ++level)
    {
        cells.emplace_back(device, "baseline/thesis_level_cells", cellsAt(level));
    }
    partials = {device, "baseline/thesis_partials", divideUp(cellsAt(grid.depth - 1), gpu::kThesisLevelGroup)};
}

void buildLevels(vk::FrameGraph& graph, const ThesisCells& cells, const ThesisBuildOptions& options,
                 ThesisLevels& levels, PointerOctree& octree)
{
    makeLevels(graph, {cells, options, levels, octree, octree.root, false});
}

void mergeLevels(vk::FrameGraph& graph, const ThesisCells& cells, const ThesisBuildOptions& options,
                 ThesisLevels& levels, PointerOctree& octree)
{
    makeLevels(graph, {cells, options, levels, octree, octree.static_count, true});
}

ThesisBuild buildThesis(vk::HeadlessDevice& device, const ThesisCells& cells, const ThesisBuildOptions& options,
                        ThesisLevels& levels)
{
    ThesisBuild result;
    PointerOctree& octree = result.octree;
    octree.grid = cells.grid;
    const auto record = [&](vk::FrameGraph& graph) { buildLevels(graph, cells, options, levels, octree); };
    device.run(record);
    octree.node_count = checkedCount(countNodes(device, levels));
    octree.static_count = octree.node_count;
    octree.nodes = {device.device(), "baseline/pointer_nodes", octree.node_count};
    result.passes = device.run(record);
    return result;
}

std::vector<vk::PassTime> updateThesis(vk::HeadlessDevice& device, const ThesisCells& cells,
                                       const ThesisBuildOptions& options, ThesisLevels& levels, PointerOctree& octree)
{
    if (cells.grid != octree.grid)
    {
        throw Error(ErrorCode::Usage, "a dynamic object and the octree that it is merged with need the same grid");
    }
    const auto record = [&](vk::FrameGraph& graph) { mergeLevels(graph, cells, options, levels, octree); };
    std::vector<vk::PassTime> passes = device.run(record);
    const std::uint32_t needed = checkedCount(octree.static_count + countNodes(device, levels));
    if (needed > octree.nodes.count())
    {
        vk::BufferOf<gpu::PointerNode> larger(device.device(), octree.nodes.name(), needed);
        device.run([&](vk::FrameGraph& graph)
                   { graph.copy(octree.nodes, 0, larger, 0, octree.static_count * sizeof(gpu::PointerNode)); });
        octree.nodes = std::move(larger);
        passes = device.run(record);
    }
    octree.root = octree.static_count;
    octree.node_count = needed;
    return passes;
}

} // namespace zvo::baseline
