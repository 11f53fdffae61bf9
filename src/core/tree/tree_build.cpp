// SPDX-License-Identifier: MIT
#include "core/tree/tree_build.h"

#include "core/base/color_word.h"
#include "core/base/morton.h"
#include "core/tree/rgb9e5.h"
#include "zvo/error.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace zvo
{

namespace
{

std::uint32_t rankOf(std::uint64_t mask, std::uint64_t cell)
{
    return static_cast<std::uint32_t>(std::popcount(mask & ((std::uint64_t{1} << cell) - 1)));
}

} // namespace

bool hasVoxel(const TreeData& tree, const glm::ivec3& cell)
{
    const auto resolution = static_cast<int>(tree.grid.resolution());
    if (tree.nodes.empty() || glm::any(glm::lessThan(cell, glm::ivec3(0))) ||
        glm::any(glm::greaterThanEqual(cell, glm::ivec3(resolution))))
    {
        return false;
    }
    const std::uint64_t code = codeOfCell(glm::uvec3(cell));
    std::uint32_t index = 0;
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        const gpu::Node& node = tree.nodes[index];
        const bool is_leaf = level + 1 == tree.levels.size();
        const bool is_filled_leaf = is_leaf && tree.isFilled();
        const std::uint64_t mask =
            is_filled_leaf ? tree.occupied[index - tree.levels.back().first_node] : cellMask(node);
        if (!is_leaf && mask == 0)
        {
            return true; // a full node
        }
        const std::uint64_t child = code >> (kCellBits * (tree.levels.size() - 1 - level)) & 63U;
        if ((mask >> child & 1U) == 0)
        {
            return false;
        }
        if (!is_leaf)
        {
            index = tree.child(node, rankOf(mask, child));
        }
    }
    return true;
}

TreeData octreeOfVoxels(const Grid& grid, std::span<const std::uint64_t> codes)
{
    TreeData tree;
    tree.grid = grid;
    if (codes.empty())
    {
        return tree;
    }
    std::uint64_t child_end = 0; // of the level's cells: where the next level's nodes end
    for (std::uint32_t level = 0; level < grid.nodeLevels(); ++level)
    {
        const bool is_leaf = level + 1 == grid.nodeLevels();
        const std::uint32_t shift = kCellBits * (grid.nodeLevels() - 1 - level); // from a voxel's code to its cell's
        const std::size_t first_node = tree.nodes.size();
        std::uint64_t last_cell = UINT64_MAX;
        for (const std::uint64_t code : codes)
        {
            const std::uint64_t cell = code >> shift;
            if (cell == last_cell)
            {
                continue;
            }
            if (last_cell == UINT64_MAX || cell >> kCellBits != last_cell >> kCellBits)
            {
                tree.nodes.emplace_back();
            }
            gpu::Node& node = tree.nodes.back();
            ((cell & 32U) == 0 ? node.mask_lo : node.mask_hi) |= 1U << (cell & 31U);
            last_cell = cell;
        }
        child_end = is_leaf ? 0 : tree.nodes.size();
        for (std::size_t i = first_node; i < tree.nodes.size(); ++i)
        {
            gpu::Node& node = tree.nodes[i];
            node.base_lo = static_cast<std::uint32_t>(child_end);
            node.base_hi = node.base_lo + static_cast<std::uint32_t>(std::popcount(node.mask_lo));
            child_end += static_cast<std::uint32_t>(std::popcount(cellMask(node)));
        }
        tree.levels.push_back(
            {static_cast<std::uint32_t>(first_node), static_cast<std::uint32_t>(tree.nodes.size() - first_node)});
        if (tree.nodes.size() > UINT32_MAX || child_end > UINT32_MAX)
        {
            throw Error(ErrorCode::Memory, "more voxels or nodes than 32-bit numbers count; take fewer voxels");
        }
    }
    tree.voxel_count = static_cast<std::uint32_t>(child_end);
    tree.octree_node_count = static_cast<std::uint32_t>(tree.nodes.size());
    return tree;
}

void addColors(TreeData& octree, std::span<const std::uint32_t> colors)
{
    assert(colors.size() == octree.voxel_count);
    octree.voxel_attributes.reserve(colors.size());
    for (const std::uint32_t color : colors)
    {
        octree.voxel_attributes.push_back({color & kColorMask, gpu::kNoNormal});
    }
}

void addEmission(TreeData& octree, std::span<const glm::vec3> emission)
{
    assert(emission.empty() || emission.size() == octree.voxel_count);
    float most = 0;
    for (const glm::vec3& radiance : emission)
    {
        most = std::max({most, radiance.r, radiance.g, radiance.b});
    }
    if (most == 0.0F)
    {
        return;
    }
    octree.emission_scale = most;
    for (std::size_t i = 0; i < emission.size(); ++i)
    {
        if (i % gpu::kVoxelsPerEmissionWord == 0)
        {
            octree.emission_words.push_back({0, static_cast<std::uint32_t>(octree.emission.size())});
        }
        if (emission[i] != glm::vec3(0.0F))
        {
            octree.emission_words.back().x |= 1U << i % gpu::kVoxelsPerEmissionWord;
            octree.emission.push_back(encodeRgb9e5(emission[i] / most));
            octree.voxel_attributes[i].color |= gpu::kAttributeEmissive << 24U;
        }
    }
}

} // namespace zvo
