// SPDX-License-Identifier: MIT
#include "core/headless/svdag_forest.h"

#include "core/base/divide_up.h"
#include "core/headless/compress.h"
#include "svdag/svdag.h"
#include "zvo/error.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <span>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kJoinedPerWord = 2;                                   // entries, of a pool of several parts
constexpr std::uint64_t kNodeEntries = sizeof(gpu::Node) / sizeof(gpu::uint); // in the room of a node, then
constexpr std::uint64_t kUnmergedMin = 1 << 16; // nodes that may stand unmerged, whatever the rest has

std::uint64_t maskOf(const gpu::Node& node)
{
    return node.mask_lo | std::uint64_t{node.mask_hi} << 32;
}

// The nodes above the roots of tiles, and their lists.
struct Top
{
    std::vector<DeviceTree::Level> levels;
    std::vector<gpu::Node> nodes;
    std::vector<gpu::uint> lists;
};

// The codes of the parents of the nodes with these codes, both ascending.
std::vector<std::uint64_t> parentCodes(std::span<const std::uint64_t> codes)
{
    std::vector<std::uint64_t> parents;
    for (const std::uint64_t code : codes)
    {
        if (parents.empty() || parents.back() != code >> kCellBits)
        {
            parents.push_back(code >> kCellBits);
        }
    }
    return parents;
}

// roots: numbers of the tiles' roots. first_entry: index of the lists' first one.
Top topOf(std::span<const std::uint64_t> codes, std::span<const std::uint32_t> roots, std::size_t level_count,
          std::uint64_t first_entry)
{
    std::vector<std::vector<std::uint64_t>> codes_of = {{codes.begin(), codes.end()}}; // by level, the tiles first
    for (std::size_t i = 0; i < level_count; ++i)
    {
        codes_of.push_back(parentCodes(codes_of.back()));
    }
    std::ranges::reverse(codes_of);
    assert(codes_of.front().size() == 1);
    Top top;
    for (std::size_t level = 0; level < level_count; ++level)
    {
        top.levels.push_back(
            {static_cast<std::uint32_t>(top.nodes.size()), static_cast<std::uint32_t>(codes_of[level].size())});
        const std::size_t first_child = top.nodes.size() + codes_of[level].size();
        const std::vector<std::uint64_t>& children = codes_of[level + 1];
        std::size_t child = 0;
        for (const std::uint64_t code : codes_of[level])
        {
            std::uint64_t mask = 0;
            const auto base = static_cast<std::uint32_t>(first_entry + top.lists.size());
            for (; child < children.size() && children[child] >> kCellBits == code; ++child)
            {
                mask |= std::uint64_t{1} << (children[child] & ((1U << kCellBits) - 1));
                top.lists.push_back(level + 1 == level_count ? roots[child]
                                                             : static_cast<std::uint32_t>(first_child + child));
            }
            const auto low = static_cast<std::uint32_t>(mask);
            const auto in_low = static_cast<std::uint32_t>(std::popcount(low));
            top.nodes.push_back({low, gpu::kChildList | base, static_cast<std::uint32_t>(mask >> 32),
                                 gpu::kChildList | (base + in_low)});
        }
    }
    return top;
}

// The position of a part in the common pool.
struct PartOffsets
{
    std::vector<std::uint64_t> first_nodes; // of each level
    std::uint64_t first_entry = 0;          // of its lists
};

// The positions of all parts in the common pool, and what that pool has.
struct JoinedLayout
{
    std::vector<PartOffsets> parts;
    std::vector<DeviceTree::Level> levels;
    ListPacking packing;
};

// codes: of the tiles' roots, which are at level top_levels. Throws Error{Memory} if 31-bit numbers do not suffice.
JoinedLayout layoutOf(std::span<const DeviceTree* const> dags, std::span<const std::uint64_t> codes,
                      std::size_t top_levels)
{
    const std::vector<std::uint32_t> no_roots(codes.size());
    const Top top = topOf(codes, no_roots, top_levels, 0); // for its size
    const std::size_t level_count = dags.front()->levels.size();
    JoinedLayout layout;
    layout.parts.resize(dags.size());
    layout.levels = top.levels;
    std::uint64_t node_count = top.nodes.size();
    for (std::size_t level = top_levels; level < level_count; ++level)
    {
        const std::uint64_t first_node = node_count;
        for (std::size_t i = 0; i < dags.size(); ++i)
        {
            layout.parts[i].first_nodes.resize(level_count);
            layout.parts[i].first_nodes[level] = node_count;
            node_count += dags[i]->levels[level].node_count;
        }
        layout.levels.push_back(
            {static_cast<std::uint32_t>(first_node), static_cast<std::uint32_t>(node_count - first_node)});
    }
    std::uint64_t entry_count = divideUp(top.lists.size(), kNodeEntries) * kNodeEntries;
    for (std::size_t i = 0; i < dags.size(); ++i)
    {
        layout.parts[i].first_entry = node_count * kNodeEntries + entry_count;
        entry_count += dags[i]->lists.entry_count;
    }
    layout.packing = {node_count, entry_count, kJoinedPerWord};
    if (!layout.packing.fits())
    {
        throw Error(ErrorCode::Memory, "the tiles' nodes and lists take more words than 31-bit numbers count; lower "
                                       "the resolution");
    }
    return layout;
}

// Allocates the common pool and uploads the nodes and lists above the tiles' roots.
void makePool(vk::HeadlessDevice& device, const Top& top, const ListPacking& packing, DeviceTree& tree)
{
    device.device().memory().require(packing.poolNodes() * sizeof(gpu::Node), "joining the tiles");
    tree.nodes = {device.device(), "svdag/forest", packing.poolNodes()};
    device.upload(tree.nodes, std::span<const gpu::Node>(top.nodes));
    device.upload(tree.nodes, std::span<const gpu::Node>(entriesToNodes(top.lists, packing.per_word)),
                  packing.node_count);
}

void appendLevel(vk::FrameGraph& graph, const DeviceTree& from, std::size_t level, const PartOffsets& offsets,
                 DeviceTree& to)
{
    const auto [first_node, node_count] = from.levels[level];
    if (level + 1 == from.levels.size())
    {
        graph.copy(from.nodes, first_node * sizeof(gpu::Node), to.nodes, offsets.first_nodes[level] * sizeof(gpu::Node),
                   node_count * sizeof(gpu::Node));
        return;
    }
    vk::Pass pass = graph.addPass(gpu::svdag::Append{.entries_per_word = from.entriesPerWord()});
    gpu::AppendParams params{};
    params.from = pass.read(from.nodes);
    params.to = pass.readWrite(to.nodes);
    params.to_entries = {params.to.address};
    params.first_from = first_node;
    params.first_to = static_cast<std::uint32_t>(offsets.first_nodes[level]);
    params.node_count = node_count;
    params.entry_shift = static_cast<std::uint32_t>(offsets.first_entry - from.packing().firstEntry());
    params.child_shift = static_cast<std::uint32_t>(offsets.first_nodes[level + 1] - from.levels[level + 1].first_node);
    pass.dispatch(node_count, params);
}

// Appends the parts' levels from the tiles' roots down.
void appendParts(vk::FrameGraph& graph, std::span<const DeviceTree* const> dags, std::size_t top_levels,
                 const JoinedLayout& layout, DeviceTree& to)
{
    for (std::size_t i = 0; i < dags.size(); ++i)
    {
        for (std::size_t level = top_levels; level < layout.levels.size(); ++level)
        {
            appendLevel(graph, *dags[i], level, layout.parts[i], to);
        }
    }
}

} // namespace

SvdagForest::SvdagForest(vk::HeadlessDevice& device, const Grid& grid, std::uint32_t tile_depth)
    : m_device(device), m_grid(grid), m_top_levels(grid.nodeLevels() - tile_depth / 2)
{
    assert(tile_depth % 2 == 0 && tile_depth < grid.depth);
}

void SvdagForest::add(std::uint64_t code, DeviceTree dag)
{
    assert(m_parts.empty() || m_parts.back().tiles.back().code < code);
    dag.voxel_attributes = {};
    dag.node_attributes = {};
    dag.emission_words = {};
    dag.emission = {};
    dag.lists.before = {};
    dag.lists.voxels_before_leaf = {};
    Part part;
    part.tiles = {{code, dag.levels[m_top_levels].first_node}};
    part.dag = std::move(dag);
    m_parts.push_back(std::move(part));

    // What is not merged is at most as much as what is, so that all merges together cost a few times the result.
    std::uint64_t unmerged = 0;
    for (std::size_t i = 1; i < m_parts.size(); ++i)
    {
        unmerged += m_parts[i].dag.node_count;
    }
    if (unmerged > std::max<std::uint64_t>(m_parts.front().dag.node_count, kUnmergedMin))
    {
        merge(false);
    }
}

std::vector<std::uint64_t> SvdagForest::tileCodes() const
{
    std::vector<std::uint64_t> codes;
    for (const Part& part : m_parts)
    {
        for (const Tile& tile : part.tiles)
        {
            codes.push_back(tile.code);
        }
    }
    return codes;
}

std::uint64_t SvdagForest::topNodeCount() const
{
    std::vector<std::uint64_t> codes = tileCodes();
    std::uint64_t count = 0;
    for (std::size_t level = 0; level < m_top_levels; ++level)
    {
        codes = parentCodes(codes);
        count += codes.size();
    }
    return count;
}

// Puts all parts into one pool, below common nodes. Equal nodes of different parts stay separate.
SvdagForest::Part SvdagForest::joined()
{
    std::vector<const DeviceTree*> dags;
    for (const Part& part : m_parts)
    {
        dags.push_back(&part.dag);
    }
    const std::vector<std::uint64_t> codes = tileCodes();
    const JoinedLayout layout = layoutOf(dags, codes, m_top_levels);

    Part all;
    std::vector<std::uint32_t> roots;
    for (std::size_t i = 0; i < m_parts.size(); ++i)
    {
        const std::uint64_t first_root = m_parts[i].dag.levels[m_top_levels].first_node;
        for (const Tile& tile : m_parts[i].tiles)
        {
            roots.push_back(
                static_cast<std::uint32_t>(layout.parts[i].first_nodes[m_top_levels] + (tile.root - first_root)));
            all.tiles.push_back({tile.code, roots.back()});
        }
    }
    const Top top = topOf(codes, roots, m_top_levels, layout.packing.firstEntry());

    DeviceTree& tree = all.dag;
    tree.structure = TreeStructure::Svdag;
    tree.grid = m_grid;
    tree.node_count = static_cast<std::uint32_t>(layout.packing.node_count);
    tree.levels = layout.levels;
    tree.lists.entry_count = layout.packing.entry_count;
    tree.lists.entries_per_word = layout.packing.per_word;
    makePool(m_device, top, layout.packing, tree);
    const std::vector<vk::PassTime> passes =
        m_device.run([&](vk::FrameGraph& graph) { appendParts(graph, dags, m_top_levels, layout, tree); });
    m_passes.insert(m_passes.end(), passes.begin(), passes.end());
    return all;
}

// Finds the roots of the tiles in a DAG in which equal nodes have been merged.
void SvdagForest::learnRoots(Part& part) const
{
    const DeviceTree& tree = part.dag;
    const std::vector<gpu::Node> nodes = m_device.download(tree.nodes, 0, tree.levels[m_top_levels].first_node);
    std::uint64_t entry_count = 0;
    for (const gpu::Node& node : nodes)
    {
        entry_count += static_cast<std::uint64_t>(std::popcount(maskOf(node)));
    }
    const ListPacking packing = {tree.node_count, entry_count, tree.lists.entries_per_word};
    const std::vector<gpu::uint> lists =
        nodesToEntries(m_device.download(tree.nodes, tree.node_count, packing.poolNodes() - tree.node_count), packing);
    const auto childOf = [&](const gpu::Node& node, std::uint64_t cell)
    {
        const auto before = static_cast<std::uint64_t>(std::popcount(maskOf(node) & ((std::uint64_t{1} << cell) - 1)));
        return lists[(node.base_lo & ~gpu::kChildList) - packing.firstEntry() + before];
    };
    for (Tile& tile : part.tiles)
    {
        tile.root = 0;
        for (std::size_t level = 0; level < m_top_levels; ++level)
        {
            const auto shift = static_cast<std::uint32_t>(kCellBits * (m_top_levels - 1 - level));
            tile.root = childOf(nodes[tile.root], tile.code >> shift & ((1U << kCellBits) - 1));
        }
    }
}

void SvdagForest::merge(bool ranks)
{
    Part all = joined();
    m_parts.clear();
    CompressResult result = compress(m_device, std::move(all.dag), {.table_slots = 0, .ranks = ranks});
    m_passes.insert(m_passes.end(), result.passes.begin(), result.passes.end());
    all.dag = std::move(result.dag);
    learnRoots(all);
    m_parts.push_back(std::move(all));
}

DeviceTree SvdagForest::finish(bool ranks)
{
    if (m_parts.empty())
    {
        DeviceTree empty;
        empty.structure = TreeStructure::Svdag;
        empty.grid = m_grid;
        return empty;
    }
    merge(ranks);
    DeviceTree dag = std::move(m_parts.front().dag);
    m_parts.clear();
    return dag;
}

} // namespace zvo
