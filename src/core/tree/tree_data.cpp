// SPDX-License-Identifier: MIT
#include "core/tree/tree_data.h"

#include "core/base/divide_up.h"
#include "core/base/morton.h"
#include "core/tree/leaf_words.h"
#include "core/tree/tree_limits.h"
#include "vk/device.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

namespace zvo
{

namespace
{

template <typename T> std::uint64_t bytesOf(const std::vector<T>& values)
{
    return values.size() * sizeof(T);
}

template <typename T> vk::BufferOf<T> uploadVector(vk::Uploader& device, const char* name, const std::vector<T>& values)
{
    return values.empty() ? vk::BufferOf<T>() : device.makeBuffer(name, std::span(values));
}

} // namespace

const char* structureName(TreeStructure structure)
{
    return structure == TreeStructure::Svo ? "svo" : "svdag";
}

std::uint64_t TreeData::geometryBytes() const
{
    const std::uint32_t leaf_words = leafWordsOf(levels);
    const std::uint64_t node_words = 2 * nodes.size() - leaf_words;
    const bool has_groups = structure == TreeStructure::Svo && leaf_words != 0;
    const std::uint64_t group_words = has_groups ? gpu::kFirstLeafGroup + divideUp(node_words, gpu::kLeafGroup) : 0;
    const std::uint64_t list_words = ListPacking::tightest(node_words, node_words, lists.size()).wordCount();
    const std::uint64_t full_nodes = firstFullNode(nodes.size() - leaf_words, leaf_words) + gpu::kFullNodeCount;
    if (isFilled() && structure == TreeStructure::Svdag)
    {
        const std::uint64_t words = 2 * (nodes.size() + 1); // with the full node
        return (words + ListPacking::tightest(words, words, gpu::kFullEntries + lists.size()).wordCount()) *
               sizeof(std::uint64_t);
    }
    if (isFilled())
    {
        return (2 * full_nodes + leaf_words + group_words) * sizeof(std::uint64_t);
    }
    return (node_words + group_words + list_words) * sizeof(std::uint64_t);
}

std::uint64_t TreeData::rankBytes() const
{
    const bool has_full = isFilled() && !voxels_before_leaf.empty();
    return bytesOf(before) + bytesOf(voxels_before_leaf) +
           (has_full ? gpu::kFullEntries * sizeof(gpu::BeforeChild) : 0);
}

std::uint64_t TreeData::attributeBytes() const
{
    return rankBytes() + bytesOf(voxel_attributes) + bytesOf(node_attributes) + bytesOf(packed.voxels) +
           bytesOf(packed.nodes) + bytesOf(emission_words) + bytesOf(emission);
}

DeviceTree uploadTree(vk::Uploader& device, const TreeData& tree)
{
    requireIndexable(divideUp(tree.geometryBytes(), sizeof(gpu::Node)),
                     tree.hasAttributes() ? std::max(tree.voxel_count, tree.octree_node_count) : 0);
    device.device().memory().require(tree.geometryBytes() + tree.attributeBytes(), "the tree");
    TreePool pool = poolOf(tree);
    DeviceTree copy;
    copy.structure = tree.structure;
    copy.grid = tree.grid;
    copy.node_count = static_cast<std::uint32_t>(tree.nodes.size());
    copy.leaf_words = pool.leaf_words;
    copy.voxel_count = tree.voxel_count;
    copy.filled = tree.isFilled();
    copy.interior_count = tree.interior_count;
    copy.levels = tree.levels;
    copy.voxel_attributes = uploadVector(device, "octree/voxel_attributes", tree.voxel_attributes);
    copy.node_attributes = uploadVector(device, "octree/node_attributes", tree.node_attributes);
    copy.packed = {tree.packed.format, uploadVector(device, "packed voxel attributes", tree.packed.voxels),
                   uploadVector(device, "packed node attributes", tree.packed.nodes)};
    copy.emission_words = uploadVector(device, "octree/emission_words", tree.emission_words);
    copy.emission = uploadVector(device, "octree/emission", tree.emission);
    copy.emission_scale = tree.emission_scale;
    copy.nodes = uploadVector(device, tree.structure == TreeStructure::Svo ? "octree/nodes" : "svdag/pool", pool.nodes);
    copy.leaf_groups = uploadVector(device, "octree/leaf_groups", pool.leaf_groups);
    std::vector<gpu::BeforeChild> before;
    if (copy.fullEntries() != 0 && !tree.voxels_before_leaf.empty())
    {
        before.assign(copy.fullEntries(), {0, gpu::kInteriorIndex});
    }
    before.insert(before.end(), tree.before.begin(), tree.before.end());
    copy.lists = {tree.octree_node_count,
                  copy.fullEntries() + tree.lists.size(),
                  pool.entries_per_word,
                  copy.fullEntries() + tree.long_entry_count,
                  uploadVector(device, "svdag/before", before),
                  uploadVector(device, "svdag/voxels_before_leaf", tree.voxels_before_leaf)};
    return copy;
}

void forEachVoxel(const TreeData& tree, const std::function<void(std::uint64_t code)>& what)
{
    forEachCell(tree,
                [&](std::uint64_t code, bool on_surface)
                {
                    if (on_surface)
                    {
                        what(code);
                    }
                });
}

void forEachCell(const TreeData& tree, const std::function<void(std::uint64_t code, bool on_surface)>& what)
{
    struct Open // a node with children still to come
    {
        const gpu::Node* node; // none below a full one
        std::uint64_t rest;    // cells
        std::uint32_t rank;    // of the next child
        std::uint64_t code;
    };
    constexpr std::uint64_t kAll = ~std::uint64_t{0};
    std::vector<Open> path;
    const auto open = [&](std::uint32_t index, std::uint64_t code)
    {
        const gpu::Node& node = tree.nodes[index];
        const bool is_leaf = tree.isFilled() && path.size() + 1 == tree.levels.size();
        const std::uint64_t cells = is_leaf ? tree.occupied[index - tree.levels.back().first_node] : cellMask(node);
        const bool is_full = !is_leaf && cells == 0;
        path.push_back({is_full ? nullptr : &node, is_full ? kAll : cells, 0, code});
    };
    if (!tree.nodes.empty())
    {
        open(0, 0);
    }
    while (!path.empty())
    {
        Open& last = path.back();
        if (last.rest == 0)
        {
            path.pop_back();
            continue;
        }
        const int cell = std::countr_zero(last.rest);
        const std::uint64_t code = last.code << kCellBits | static_cast<std::uint64_t>(cell);
        last.rest &= last.rest - 1;
        if (path.size() == tree.levels.size())
        {
            what(code, last.node != nullptr && (cellMask(*last.node) >> cell & 1) != 0);
        }
        else if (last.node != nullptr)
        {
            open(tree.child(*last.node, last.rank++), code);
        }
        else
        {
            path.push_back({nullptr, kAll, 0, code});
        }
    }
}

std::uint64_t interiorCount(const TreeData& tree)
{
    if (!tree.isFilled())
    {
        return 0;
    }
    std::vector<std::uint64_t> below; // of the nodes of the level below
    std::uint64_t voxels = 1;         // of a full node
    for (std::size_t level = tree.levels.size(); level-- > 0; voxels <<= kCellBits)
    {
        std::vector<std::uint64_t> counts(tree.levels[level].node_count);
        for (std::uint32_t i = 0; i < counts.size(); ++i)
        {
            const gpu::Node& node = tree.nodes[tree.levels[level].first_node + i];
            const auto child_count = static_cast<std::uint32_t>(std::popcount(cellMask(node)));
            if (level + 1 == tree.levels.size())
            {
                counts[i] = static_cast<std::uint64_t>(std::popcount(tree.occupied[i] & ~cellMask(node)));
                continue;
            }
            counts[i] = child_count == 0 ? voxels << kCellBits : 0;
            for (std::uint32_t rank = 0; rank < child_count; ++rank)
            {
                counts[i] += below[tree.child(node, rank) - tree.levels[level + 1].first_node];
            }
        }
        below = std::move(counts);
    }
    return below.front();
}

std::optional<CellBox> voxelBox(const TreeData& tree)
{
    if (tree.nodes.empty())
    {
        return std::nullopt;
    }
    std::vector<CellBox> below; // of the nodes of the level below, from their corners
    std::uint32_t edge = 1;     // voxels, of a cell
    for (std::size_t level = tree.levels.size(); level-- > 0; edge *= 4)
    {
        std::vector<CellBox> boxes(tree.levels[level].node_count);
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
        {
            const gpu::Node& node = tree.nodes[tree.levels[level].first_node + i];
            std::uint32_t rank = 0;
            const std::uint64_t mask = below.empty() && tree.isFilled() ? tree.occupied[i] : cellMask(node);
            if (mask == 0) // a full node
            {
                boxes[i] = {glm::uvec3(0U), glm::uvec3(4 * edge)};
            }
            for (std::uint64_t rest = mask; rest != 0; rest &= rest - 1, ++rank)
            {
                const auto cell = static_cast<std::uint32_t>(std::countr_zero(rest));
                const glm::uvec3 corner = edge * cellOfCode(cell);
                CellBox inner = {glm::uvec3(0U), glm::uvec3(1U)};
                if (!below.empty())
                {
                    inner = below[tree.child(node, rank) - tree.levels[level + 1].first_node];
                }
                boxes[i].min = glm::min(boxes[i].min, corner + inner.min);
                boxes[i].max = glm::max(boxes[i].max, corner + inner.max);
            }
        }
        below = std::move(boxes);
    }
    return below.front();
}

} // namespace zvo
