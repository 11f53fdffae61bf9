// SPDX-License-Identifier: MIT
#include "support/octree_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace zvo::test
{

namespace
{

std::string describe(const Cell& cell)
{
    return fmt::format("level {} code {:#x} color {:#x} normal {:#x} emission {:#x}", cell.level, cell.code,
                       cell.attribute.color, cell.attribute.normal, cell.emission);
}

// Children come in their order.
void addChild(gpu::Node& node, std::uint32_t c, std::uint32_t number)
{
    if ((node.mask_lo | node.mask_hi) == 0)
    {
        node.base_lo = number;
        node.base_hi = number;
    }
    if (c < 32)
    {
        node.mask_lo |= 1U << c;
        ++node.base_hi;
    }
    else
    {
        node.mask_hi |= 1U << (c - 32);
    }
}

} // namespace

std::vector<Cell> cellsOf(vk::HeadlessDevice& device, const Octree& octree)
{
    std::vector<Cell> cells;
    if (octree.node_count == 0)
    {
        return cells;
    }
    const std::vector<gpu::Node> nodes = device.download(octree.nodes);
    const std::vector<gpu::Attribute> attributes = device.download(octree.voxel_attributes);
    const std::vector<gpu::Attribute> averages = device.download(octree.node_attributes);
    const std::vector<gpu::uvec2> words = device.download(octree.emission_words);
    const std::vector<gpu::uint> emission = device.download(octree.emission);
    struct Place
    {
        std::uint64_t code;
        std::uint32_t node;
    };
    std::vector<Place> level = {{0, 0}};
    if ((nodes[0].mask_lo | nodes[0].mask_hi) == 0)
    {
        return cells;
    }
    for (std::uint32_t depth = 0; depth < octree.grid.nodeLevels(); ++depth)
    {
        std::vector<Place> children;
        for (const auto& [code, number] : level)
        {
            const gpu::Node& node = nodes.at(number);
            cells.push_back({depth, code, averages.empty() ? gpu::Attribute{} : averages.at(number), 0});
            for (std::uint32_t c = 0; c < 64; ++c)
            {
                const std::uint32_t mask = c < 32 ? node.mask_lo : node.mask_hi;
                const std::uint32_t bit = 1U << (c & 31U);
                if ((mask & bit) != 0)
                {
                    const std::uint32_t base = c < 32 ? node.base_lo : node.base_hi;
                    const auto below = static_cast<std::uint32_t>(std::popcount(mask & (bit - 1)));
                    children.push_back({code << 6 | c, base + below});
                }
            }
        }
        level = std::move(children);
    }
    for (const auto& [code, voxel] : level)
    {
        Cell cell = {octree.grid.nodeLevels(), code, {}, 0};
        if (!attributes.empty())
        {
            cell.attribute = attributes.at(voxel);
        }
        if (((cell.attribute.color >> 24) & gpu::kAttributeEmissive) != 0)
        {
            const gpu::uvec2 word = words.at(voxel / 32);
            const std::uint32_t below = (1U << (voxel % 32)) - 1;
            cell.emission = emission.at(word.y + static_cast<std::uint32_t>(std::popcount(word.x & below)));
        }
        cells.push_back(cell);
    }
    return cells;
}

Octree octreeOf(vk::HeadlessDevice& device, const std::vector<Cell>& cells, const Grid& grid, float emission_scale)
{
    const std::uint32_t levels = grid.nodeLevels();
    const auto node_count = static_cast<std::size_t>(std::ranges::find(cells, levels, &Cell::level) - cells.begin());
    std::vector<gpu::Node> nodes(node_count);
    std::vector<gpu::Attribute> averages;
    std::vector<gpu::Attribute> attributes;
    std::vector<gpu::uvec2> words;
    std::vector<gpu::uint> emission;
    Octree octree;
    octree.grid = grid;
    octree.node_count = static_cast<std::uint32_t>(node_count);
    octree.voxel_count = static_cast<std::uint32_t>(cells.size() - node_count);
    octree.emission_scale = emission_scale;
    std::size_t parent = 0; // a node's number is its place among cells
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        const Cell& cell = cells[i];
        const bool is_voxel = cell.level == levels;
        const auto number = static_cast<std::uint32_t>(is_voxel ? i - node_count : i);
        if (i != 0)
        {
            while (cells.at(parent).level + 1 != cell.level || cells.at(parent).code != cell.code >> 6)
            {
                ++parent;
            }
            addChild(nodes.at(parent), static_cast<std::uint32_t>(cell.code & 63U), number);
        }
        if (!is_voxel)
        {
            octree.levels.resize(cell.level + 1, {number, 0});
            ++octree.levels.back().node_count;
            averages.push_back(cell.attribute);
            continue;
        }
        attributes.push_back(cell.attribute);
        if (number % 32 == 0)
        {
            words.emplace_back(0U, static_cast<std::uint32_t>(emission.size()));
        }
        if (((cell.attribute.color >> 24) & gpu::kAttributeEmissive) != 0)
        {
            words.back().x |= 1U << (number % 32);
            emission.push_back(cell.emission);
        }
    }
    octree.nodes = device.makeBuffer("nodes", std::span<const gpu::Node>(nodes));
    octree.node_attributes = device.makeBuffer("node attributes", std::span<const gpu::Attribute>(averages));
    octree.voxel_attributes = device.makeBuffer("voxel attributes", std::span<const gpu::Attribute>(attributes));
    octree.emission_words = device.makeBuffer("emission words", std::span<const gpu::uvec2>(words));
    octree.emission = device.makeBuffer("emission", std::span<const gpu::uint>(emission));
    return octree;
}

std::string difference(const std::vector<Cell>& actual, const std::vector<Cell>& expected)
{
    const auto [a, e] = std::ranges::mismatch(actual, expected);
    if (a == actual.end() && e == expected.end())
    {
        return "";
    }
    return fmt::format("{} cells instead of {}; the first difference: {} instead of {}", actual.size(), expected.size(),
                       a == actual.end() ? "nothing" : describe(*a), e == expected.end() ? "nothing" : describe(*e));
}

} // namespace zvo::test
