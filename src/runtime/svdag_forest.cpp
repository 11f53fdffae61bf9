// SPDX-License-Identifier: MIT
#include "runtime/svdag_forest.h"

#include "core/base/divide_up.h"
#include "runtime/tile_nodes.h"
#include "runtime/trees.h"
#include "svdag/svdag.h"
#include "zvo/error.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <iterator>
#include <span>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kJoinedPerWord = 2;                                   // entries, of a pool of several parts
constexpr std::uint64_t kNodeEntries = sizeof(gpu::Node) / sizeof(gpu::uint); // in the room of a node, then
constexpr std::uint64_t kUnmergedMin = 1 << 16; // nodes that may stand unmerged, whatever the rest has

// Gives the nodes of an octree of tiles lists, as a DAG has them. roots: numbers of the tiles' roots. first_entry:
// index of the first entry of all lists.
void makeLists(TreeData& top, std::span<const std::uint32_t> roots, std::uint64_t first_entry)
{
    for (std::uint32_t i = 0; i < top.nodes.size(); ++i)
    {
        gpu::Node& node = top.nodes[i];
        const bool is_lowest = i >= top.levels.back().first_node;
        const auto base = static_cast<std::uint32_t>(first_entry + top.lists.size());
        const auto child_count = static_cast<std::uint32_t>(std::popcount(cellMask(node)));
        for (std::uint32_t child = node.base_lo; child < node.base_lo + child_count; ++child)
        {
            top.lists.push_back(is_lowest ? roots[child] : child);
        }
        node.base_lo = gpu::kChildList | base;
        node.base_hi = gpu::kChildList | (base + static_cast<std::uint32_t>(std::popcount(node.mask_lo)));
    }
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

    // The room of a whole node, at which the lists above the tiles begin: behind an unused word, if need be.
    [[nodiscard]] std::uint64_t firstListNode() const
    {
        return divideUp(packing.node_words, ListPacking::kWordsOfNode);
    }
};

// top: the octree of the tiles. Throws Error{Memory} if 30-bit numbers do not suffice.
JoinedLayout layoutOf(std::span<const DeviceTree* const> dags, const TreeData& top)
{
    const std::size_t level_count = dags.front()->levels.size();
    JoinedLayout layout;
    layout.parts.resize(dags.size());
    layout.levels = top.levels;
    std::uint64_t node_count = top.nodes.size();
    for (std::size_t level = top.levels.size(); level < level_count; ++level)
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
    const std::uint64_t leaf_words = layout.levels.back().node_count;
    layout.packing = {2 * node_count - leaf_words, 0, kJoinedPerWord};
    const std::uint64_t top_entries = top.nodes.size() - 1 + top.voxel_count; // one names a node or tile
    std::uint64_t entry_end = (layout.firstListNode() + divideUp(top_entries, kNodeEntries)) * kNodeEntries;
    for (std::size_t i = 0; i < dags.size(); ++i)
    {
        layout.parts[i].first_entry = entry_end;
        entry_end += dags[i]->lists.entry_count;
    }
    layout.packing.entry_count = entry_end - layout.packing.firstEntry();
    if (!layout.packing.fits(gpu::kLeafWords))
    {
        throw Error(ErrorCode::Memory, "the tiles' nodes and lists take more words than 30-bit numbers count; lower "
                                       "the resolution");
    }
    return layout;
}

// Allocates the common pool and uploads the nodes and lists above the tiles' roots.
void makePool(vk::HeadlessDevice& device, const TreeData& top, const JoinedLayout& layout, DeviceTree& tree)
{
    const ListPacking& packing = layout.packing;
    device.device().memory().require(packing.poolNodes() * sizeof(gpu::Node), "joining the tiles");
    tree.nodes = {device.device(), "svdag/forest", packing.poolNodes()};
    device.upload(tree.nodes, std::span<const gpu::Node>(top.nodes));
    const std::vector<gpu::Node> lists = nodesOf(packEntries(top.lists, packing.per_word));
    device.upload(tree.nodes, std::span(lists), layout.firstListNode());
}

void appendLevel(vk::FrameGraph& graph, const DeviceTree& from, std::size_t level, const PartOffsets& offsets,
                 DeviceTree& to)
{
    constexpr std::uint64_t kWord = sizeof(std::uint64_t);
    const auto [first_node, node_count] = from.levels[level];
    if (level + 1 == from.levels.size())
    {
        graph.copy(from.nodes, (from.innerCount() + first_node) * kWord, to.nodes,
                   (to.innerCount() + offsets.first_nodes[level]) * kWord, node_count * kWord);
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
    if (level + 2 == from.levels.size()) // the numbers of words
    {
        params.child_shift += to.innerCount() - from.innerCount();
    }
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
    : m_device(device), m_grid(grid), m_tile_depth(tile_depth), m_top_levels(grid.nodeLevels() - tile_depth / 2)
{
    assert(tile_depth % 2 == 0 && tile_depth >= 4 && tile_depth < grid.depth);
}

void SvdagForest::add(std::uint64_t code, DeviceTree dag)
{
    assert(m_parts.empty() || m_parts.back().tiles.back().code < code);
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

// The nodes above the roots of the tiles.
TreeData SvdagForest::top() const
{
    std::vector<std::uint64_t> codes;
    for (const Part& part : m_parts)
    {
        std::ranges::transform(part.tiles, std::back_inserter(codes), &Tile::code);
    }
    return octreeOfTiles(m_grid, m_tile_depth, codes);
}

// Puts all parts into one pool, below common nodes. Equal nodes of different parts stay separate.
SvdagForest::Part SvdagForest::joined()
{
    std::vector<const DeviceTree*> dags;
    for (const Part& part : m_parts)
    {
        dags.push_back(&part.dag);
    }
    TreeData above = top();
    const JoinedLayout layout = layoutOf(dags, above);

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
    makeLists(above, roots, layout.firstListNode() * kNodeEntries);

    DeviceTree& tree = all.dag;
    tree.structure = TreeStructure::Svdag;
    tree.grid = m_grid;
    tree.levels = layout.levels;
    tree.node_count = tree.levels.back().first_node + tree.levels.back().node_count;
    tree.leaf_words = tree.levels.back().node_count;
    tree.lists.entry_count = layout.packing.entry_count;
    tree.lists.entries_per_word = layout.packing.per_word;
    makePool(m_device, above, layout, tree);
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
        entry_count += static_cast<std::uint64_t>(std::popcount(cellMask(node)));
    }
    const ListPacking packing = {tree.nodeWords(), entry_count, tree.lists.entries_per_word};
    const std::uint64_t first = packing.node_words / ListPacking::kWordsOfNode;
    const std::vector<std::uint64_t> words = wordsOf(m_device.download(tree.nodes, first, packing.poolNodes() - first));
    const std::vector<gpu::uint> lists = unpackEntries(
        std::span(words).subspan(packing.node_words - first * ListPacking::kWordsOfNode, packing.wordCount()),
        entry_count, packing.per_word);
    const auto childOf = [&](const gpu::Node& node, std::uint64_t cell)
    {
        const auto before =
            static_cast<std::uint64_t>(std::popcount(cellMask(node) & ((std::uint64_t{1} << cell) - 1)));
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
