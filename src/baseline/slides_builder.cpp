// SPDX-License-Identifier: MIT
#include "baseline/slides_builder.h"

#include "baseline/slides_scan.h"
#include "core/base/divide_up.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <string_view>

namespace zvo::baseline
{

namespace
{

constexpr std::uint32_t kPiecesMax = (1U << 31) - 1;
constexpr std::uint64_t kFragmentsMax = (1ULL << 31) - 1;
constexpr std::uint32_t kBitsALevel = 3; // of a Morton code

// Whether the passes of a kernel belong to a stage, and to which; nothing for those that belong to the pass before.
std::optional<SlidesStage> stageOf(std::string_view pass)
{
    constexpr std::pair<std::string_view, SlidesStage> kStages[] = {
        {"baseline/slides_pieces", SlidesStage::Voxelize},
        {"baseline/slides_fragments", SlidesStage::Voxelize},
        {"baseline/sort_", SlidesStage::Sort},
        {"baseline/slides_unique", SlidesStage::Unique},
        {"baseline/slides_average", SlidesStage::Unique},
        {"baseline/slides_parents", SlidesStage::Build},
        {"baseline/slides_class_", SlidesStage::Build},
    };
    for (const auto& [prefix, stage] : kStages)
    {
        if (pass.starts_with(prefix))
        {
            return stage;
        }
    }
    return std::nullopt;
}

// The class whose kernel takes the materials of all that occur.
MaterialClass highestClass(const GpuScene& scene, bool attributes)
{
    const auto has = [&](MaterialClass material_class) { return scene.chunksOf(material_class).workgroups() != 0; };
    if (has(MaterialClass::Alpha))
    {
        return MaterialClass::Alpha;
    }
    return attributes && has(MaterialClass::Textured) ? MaterialClass::Textured : MaterialClass::Plain;
}

float latticeScale(const Grid& grid)
{
    return static_cast<float>(gpu::kVoxelLattice / static_cast<double>(grid.voxel_size));
}

std::map<std::string, std::uint64_t> droppedTriangles(const gpu::SlidesCounters& counters)
{
    std::map<std::string, std::uint64_t> dropped = {{"nonfinite", counters.nonfinite},
                                                    {"out_of_range", counters.out_of_range},
                                                    {"outside", counters.outside},
                                                    {"zero_area", counters.zero_area}};
    std::erase_if(dropped, [](const auto& entry) { return entry.second == 0; });
    return dropped;
}

} // namespace

double SlidesResult::stageMs(SlidesStage stage) const
{
    double ms = 0;
    SlidesStage current = SlidesStage::Voxelize;
    for (const vk::PassTime& pass : passes)
    {
        current = stageOf(pass.name).value_or(current);
        ms += current == stage ? pass.ms : 0.0;
    }
    return ms;
}

double SlidesResult::ms() const
{
    return std::accumulate(passes.begin(), passes.end(), 0.0,
                           [](double sum, const vk::PassTime& pass) { return sum + pass.ms; });
}

SlidesBuilder::SlidesBuilder(vk::Device& device, const PosedGpuScene& scene, const Grid& grid,
                             const SlidesOptions& options)
    : m_device(device), m_scene(scene), m_options(options), m_counters(device, "slides/counters", 1)
{
    if (grid.depth < 1 || grid.depth > gpu::kSlidesDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a depth of {}: the baseline of the slides has 1 to {}", grid.depth,
                                                  gpu::kSlidesDepthMax));
    }
    if (options.attributes && !scene.uploaded().has_attributes)
    {
        throw Error(ErrorCode::Usage, "attributes were asked of a scene that was uploaded without them");
    }
    m_result.tree.grid = grid;
    m_result.tree.node_words = options.nodes;
    m_result.tree.is_dag = options.dag;
    for (const TriangleChunks& chunks : scene.uploaded().chunks)
    {
        m_triangle_slots += chunks.whole.count() * gpu::kChunkTriangles + chunks.single.count();
    }
    if (m_triangle_slots != 0)
    {
        m_piece_counts = {{device, "slides/piece_counts", m_triangle_slots},
                          {device, "slides/piece_partials", partialCount(m_triangle_slots)}};
        m_readback = {device, sizeof(gpu::SlidesCounters) + sizeof(std::uint64_t)};
        m_step = {&SlidesBuilder::countPieces, &SlidesBuilder::learnPieces};
    }
}

void SlidesBuilder::readCounters(vk::FrameGraph& graph)
{
    m_counters_offset = m_readback.copy(graph, m_counters, 0, 1);
}

const gpu::SlidesCounters& SlidesBuilder::counters() const
{
    return m_readback.at<gpu::SlidesCounters>(m_counters_offset, 1)[0];
}

void SlidesBuilder::walkTriangles(vk::FrameGraph& graph, bool list)
{
    std::uint64_t first_slot = 0;
    const auto walk = [&](const vk::BufferOf<gpu::Chunk>& chunks, bool single)
    {
        const std::uint64_t threads = chunks.count() * (single ? 1 : gpu::kChunkTriangles);
        if (threads == 0)
        {
            return;
        }
        vk::Pass pass =
            graph.addPass(gpu::baseline::SlidesPieces{.coverage = m_options.coverage, .list = list, .single = single});
        gpu::SlidesPiecesParams params{};
        params.scene = m_scene.read(pass);
        params.chunks = pass.read(chunks);
        params.piece_counts = pass.accumulate(m_piece_counts.values); // each word once
        params.pieces = list ? pass.accumulate(m_pieces) : gpu::Ptr<gpu::SlidesPiece>{};
        params.counters = pass.accumulate(m_counters);
        params.origin = m_result.tree.grid.origin;
        params.lattice_scale = latticeScale(m_result.tree.grid);
        params.depth = m_result.tree.grid.depth;
        params.chunk_count = static_cast<std::uint32_t>(chunks.count());
        params.first_slot = static_cast<std::uint32_t>(first_slot);
        pass.dispatch(threads, params);
        first_slot += threads;
    };
    for (const TriangleChunks& chunks : m_scene.uploaded().chunks)
    {
        walk(chunks.whole, false);
        walk(chunks.single, true);
    }
}

void SlidesBuilder::countPieces(vk::FrameGraph& graph)
{
    graph.fill(m_counters, 0);
    walkTriangles(graph, false);
    scanValues(graph, m_piece_counts.values, m_triangle_slots, m_piece_counts.partials,
               totalAt(m_counters, offsetof(gpu::SlidesCounters, piece_count)));
    readCounters(graph);
}

void SlidesBuilder::learnPieces()
{
    m_result.dropped = droppedTriangles(counters());
    const std::uint32_t count = counters().piece_count;
    if (count > kPiecesMax)
    {
        throw Error(ErrorCode::Memory, "the scene makes more than 2^31 pieces of triangles; lower the resolution");
    }
    if (count == 0)
    {
        finish();
        return;
    }
    m_pieces = {m_device, "slides/pieces", count};
    m_fragment_counts = {{m_device, "slides/fragment_counts", count},
                         {m_device, "slides/fragment_partials", partialCount(count)}};
    m_step = {&SlidesBuilder::countFragments, &SlidesBuilder::learnFragments};
}

void SlidesBuilder::walkPieces(vk::FrameGraph& graph, bool emit)
{
    const bool shades = emit && m_options.attributes;
    vk::Pass pass =
        graph.addPass(gpu::baseline::SlidesFragments{.coverage = m_options.coverage,
                                                     .material_class = highestClass(m_scene.uploaded(), shades),
                                                     .attributes = shades,
                                                     .emit = emit});
    gpu::SlidesFragmentsParams params{};
    params.scene = m_scene.read(pass);
    readColorTables(pass, m_scene.uploaded());
    params.pieces = pass.read(m_pieces);
    params.fragment_counts = pass.readWrite(m_fragment_counts.values);
    params.keys = emit ? pass.write(m_sort->keys[0]) : gpu::Ptr<uint64_t>{};
    params.fragments = shades ? pass.write(m_fragments) : gpu::Ptr<gpu::SlidesFragment>{};
    params.origin = m_result.tree.grid.origin;
    params.lattice_scale = latticeScale(m_result.tree.grid);
    params.depth = m_result.tree.grid.depth;
    params.piece_count = static_cast<std::uint32_t>(m_pieces.count());
    pass.dispatch(m_pieces.count(), params);
}

void SlidesBuilder::countFragments(vk::FrameGraph& graph)
{
    walkTriangles(graph, true);
    walkPieces(graph, false);
    scanValues(graph, m_fragment_counts.values, m_pieces.count(), m_fragment_counts.partials,
               totalAt(m_counters, offsetof(gpu::SlidesCounters, fragment_count)));
    readCounters(graph);
}

void SlidesBuilder::learnFragments()
{
    m_piece_counts = {};
    m_result.fragment_count = counters().fragment_count;
    if (m_result.fragment_count > kFragmentsMax)
    {
        throw Error(ErrorCode::Memory, "the scene makes more than 2^31 fragments; lower the resolution");
    }
    if (m_result.fragment_count == 0)
    {
        finish();
        return;
    }
    m_sort.emplace(m_device, m_result.fragment_count);
    if (m_options.attributes)
    {
        m_fragments = {m_device, "slides/fragments", m_result.fragment_count};
    }
    m_unique_partials = {m_device, "slides/unique_partials", partialCount(m_result.fragment_count)};
    m_step = {&SlidesBuilder::makeVoxels, &SlidesBuilder::learnVoxels};
}

void SlidesBuilder::makeVoxels(vk::FrameGraph& graph)
{
    walkPieces(graph, true);
    m_sorted = radixSort(graph, *m_sort, m_result.fragment_count, kBitsALevel * m_result.tree.grid.depth);
    {
        vk::Pass pass = graph.addPass(gpu::baseline::SlidesUniqueCount{});
        gpu::SlidesUniqueParams params{};
        params.keys = pass.read(m_sort->keys[m_sorted]);
        params.partials = pass.write(m_unique_partials);
        params.counters = pass.readWrite(m_counters);
        params.key_count = static_cast<std::uint32_t>(m_result.fragment_count);
        params.depth = m_result.tree.grid.depth;
        pass.dispatch(divideUp(m_result.fragment_count, gpu::kSlidesItems), params);
    }
    scanPartials(graph, m_unique_partials, m_unique_partials.count(),
                 totalAt(m_counters, offsetof(gpu::SlidesCounters, voxel_count)));
    readCounters(graph);
}

void SlidesBuilder::learnVoxels()
{
    m_pieces = {};
    m_fragment_counts = {};
    SlidesTree& tree = m_result.tree;
    const std::uint32_t depth = tree.grid.depth;
    m_cell_counts.assign(depth + 1, 0);
    std::uint32_t leaders = 0; // of voxels that are first in a cell of the level
    for (std::uint32_t level = depth + 1; level-- > 0;)
    {
        leaders += counters().leaders[level];
        m_cell_counts[level] = leaders;
    }
    tree.voxel_count = m_cell_counts[0];
    const std::uint64_t node_count = std::accumulate(m_cell_counts.begin() + 1, m_cell_counts.end(), std::uint64_t{0});
    const std::uint64_t words = static_cast<std::uint32_t>(m_options.nodes);
    if (node_count * words > UINT32_MAX)
    {
        throw Error(ErrorCode::Memory, "the nodes have more words than 32 bits number; lower the resolution");
    }
    tree.node_count = static_cast<std::uint32_t>(node_count); // of a DAG, at most
    tree.nodes = {m_device, "slides/nodes", node_count * words};
    const std::uint64_t parent_count = m_cell_counts[1];
    m_firsts = {m_device, "slides/firsts", tree.voxel_count};
    m_partials = {m_device, "slides/partials", partialCount(tree.voxel_count)};
    m_cells[0].codes = {m_device, "slides/codes", tree.voxel_count};
    m_cells[1].codes = {m_device, "slides/codes", parent_count};
    for (Cells& cells : m_cells)
    {
        cells.nodes = {m_device, "slides/cell_nodes", parent_count};
        cells.voxels = {m_device, "slides/cell_voxels", parent_count};
    }
    if (m_options.dag)
    {
        m_classes.candidates = {m_device, "slides/candidates", parent_count * words};
        m_classes.table = {m_device, "slides/table", std::bit_ceil(2 * parent_count)};
        m_classes.slots = {m_device, "slides/slots", parent_count};
        m_classes.numbers = {m_device, "slides/numbers", parent_count};
    }
    if (m_options.attributes)
    {
        tree.attributes = {m_device, "slides/attributes", tree.voxel_count};
    }
    m_step = {&SlidesBuilder::makeNodes, &SlidesBuilder::learnNodes};
}

void SlidesBuilder::learnNodes()
{
    m_sort.reset();
    m_fragments = {};
    m_firsts = {};
    m_unique_partials = {};
    m_partials = {};
    m_cells = {};
    m_classes = {};
    m_result.capped_voxels = counters().capped_voxels;
    SlidesTree& tree = m_result.tree;
    if (counters().overflow_count != 0)
    {
        throw Error(ErrorCode::Other,
                    fmt::format("{} nodes found no slot in the table of equal nodes", counters().overflow_count));
    }
    tree.level_node_counts.assign(counters().node_counts, counters().node_counts + tree.grid.depth);
    const std::uint32_t room = tree.node_count;
    tree.node_count = std::accumulate(tree.level_node_counts.begin(), tree.level_node_counts.end(), 0U);
    m_step = {};
    if (tree.node_count < room)
    {
        m_step = {&SlidesBuilder::trim, &SlidesBuilder::end};
        m_trimmed = {m_device, "slides/nodes", tree.geometryBytes() / sizeof(gpu::uint)};
    }
    else
    {
        finish();
    }
}

void SlidesBuilder::trim(vk::FrameGraph& graph)
{
    graph.copy(m_result.tree.nodes, 0, m_trimmed, 0, m_trimmed.bytes());
}

void SlidesBuilder::end()
{
    m_result.tree.nodes = std::move(m_trimmed);
    finish();
}

} // namespace zvo::baseline
