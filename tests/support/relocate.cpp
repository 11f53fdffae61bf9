// SPDX-License-Identifier: MIT
#include "support/relocate.h"

#include "support/octree_access.h"

#include <bit>
#include <random>
#include <span>
#include <string>

namespace zvo::test
{

namespace
{

constexpr std::uint32_t kUnused = ~0U;
constexpr std::uint32_t kTail = 64; // so that children of spoiled nodes exist
constexpr gpu::Node kSpoiledNode = {~0U, 0, ~0U, 0};
constexpr gpu::Attribute kSpoiledAttribute = {0xFF00FF, 0};

std::uint32_t childCount(const gpu::Node& node)
{
    return static_cast<std::uint32_t>(std::popcount(node.mask_lo) + std::popcount(node.mask_hi));
}

std::uint32_t child(const gpu::Node& node, std::uint32_t number)
{
    const auto in_lower = static_cast<std::uint32_t>(std::popcount(node.mask_lo));
    return number < in_lower ? node.base_lo + number : node.base_hi + number - in_lower;
}

gpu::Node withChildrenAt(const gpu::Node& node, std::uint32_t first)
{
    return {node.mask_lo, first, node.mask_hi, first + static_cast<std::uint32_t>(std::popcount(node.mask_lo))};
}

// A node of the new octree and the original one.
struct Pair
{
    std::uint32_t node;
    std::uint32_t original;
};

// Calls visit(pair, is_leaf) for all nodes of two octrees of the same shape, from the roots down.
template <typename Visit>
void walkPairs(std::span<const gpu::Node> nodes, std::span<const gpu::Node> originals, std::uint32_t level_count,
               const Visit& visit)
{
    std::vector<Pair> level = {{0, 0}};
    for (std::uint32_t i = 0; i < level_count; ++i)
    {
        const bool is_leaf = i + 1 == level_count;
        std::vector<Pair> next;
        for (const Pair& pair : level)
        {
            visit(pair, is_leaf);
            for (std::uint32_t c = 0; !is_leaf && c < childCount(nodes[pair.node]); ++c)
            {
                next.push_back({child(nodes[pair.node], c), child(originals[pair.original], c)});
            }
        }
        level = std::move(next);
    }
}

template <typename T>
vk::BufferOf<T> gathered(vk::HeadlessDevice& device, const vk::BufferOf<T>& buffer,
                         const std::vector<std::uint32_t>& originals, const T& spoiled)
{
    if (buffer.count() == 0)
    {
        return {};
    }
    const std::vector<T> values = device.download(buffer);
    std::vector<T> result;
    for (const std::uint32_t original : originals)
    {
        result.push_back(original != kUnused ? values.at(original) : spoiled);
    }
    return device.makeBuffer(buffer.name(), std::span<const T>(result));
}

void gatherEmission(vk::HeadlessDevice& device, const DeviceTree& octree,
                    const std::vector<std::uint32_t>& original_voxels, DeviceTree& result)
{
    if (octree.emission.count() == 0)
    {
        return;
    }
    const std::vector<gpu::uvec2> old_words = device.download(octree.emission_words);
    const std::vector<gpu::uint> old_emission = device.download(octree.emission);
    std::vector<gpu::uvec2> words(original_voxels.size() / 32 + 1, gpu::uvec2(0));
    std::vector<gpu::uint> emission;
    for (std::size_t i = 0; i < original_voxels.size(); ++i)
    {
        if (i % 32 == 0)
        {
            words[i / 32].y = static_cast<gpu::uint>(emission.size());
        }
        const std::uint32_t original = original_voxels[i];
        if (original == kUnused)
        {
            continue;
        }
        const gpu::uvec2 word = old_words.at(original / 32);
        if ((word.x >> (original % 32) & 1U) != 0)
        {
            const int rank = std::popcount(word.x & ((1U << (original % 32)) - 1U));
            words[i / 32].x |= 1U << (i % 32);
            emission.push_back(old_emission.at(word.y + static_cast<std::uint32_t>(rank)));
        }
    }
    result.emission_words = device.makeBuffer("emission words", std::span<const gpu::uvec2>(words));
    result.emission = device.makeBuffer("emission", std::span<const gpu::uint>(emission));
}

} // namespace

DeviceTree relocate(vk::HeadlessDevice& device, const DeviceTree& octree, const RelocateOptions& options)
{
    const std::vector<gpu::Node> originals = octreeNodes(device, octree);
    const std::uint32_t level_count = octree.grid.nodeLevels();
    std::mt19937 random(options.gap + options.touched_percent);
    std::vector<gpu::Node> nodes(originals);
    nodes.resize(nodes.size() + options.gap);
    std::uint32_t voxel_count = (octree.voxel_count + options.gap + 31) / 32 * 32;

    // Touched nodes whose children are not placed yet, in Morton order.
    std::vector<std::uint32_t> touched = {0};
    for (std::uint32_t level = 0; level < level_count; ++level)
    {
        const bool is_leaf = level + 1 == level_count;
        nodes.resize(nodes.size() + (level != 0 && !is_leaf ? options.level_gap : 0));
        std::vector<std::uint32_t> next;
        for (const std::uint32_t index : touched)
        {
            const gpu::Node old = nodes[index];
            if (is_leaf)
            {
                nodes[index] = withChildrenAt(old, voxel_count);
                voxel_count += childCount(old);
                continue;
            }
            nodes[index] = withChildrenAt(old, static_cast<std::uint32_t>(nodes.size()));
            for (std::uint32_t c = 0; c < childCount(old); ++c)
            {
                if (random() % 100 < options.touched_percent)
                {
                    next.push_back(static_cast<std::uint32_t>(nodes.size()));
                }
                nodes.push_back(nodes[child(old, c)]);
            }
        }
        touched = std::move(next);
    }

    std::vector<std::uint32_t> original_nodes(nodes.size() + kTail, kUnused); // of each node of the new octree
    std::vector<std::uint32_t> original_voxels(voxel_count + kTail, kUnused);
    walkPairs(nodes, originals, level_count,
              [&](const Pair& pair, bool is_leaf)
              {
                  original_nodes[pair.node] = pair.original;
                  for (std::uint32_t c = 0; is_leaf && c < childCount(nodes[pair.node]); ++c)
                  {
                      original_voxels.at(child(nodes[pair.node], c)) = child(originals[pair.original], c);
                  }
              });
    nodes.resize(original_nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        nodes[i] = original_nodes[i] != kUnused ? nodes[i] : kSpoiledNode;
    }

    DeviceTree result;
    result.grid = octree.grid;
    result.node_count = static_cast<std::uint32_t>(nodes.size());
    result.voxel_count = static_cast<std::uint32_t>(original_voxels.size());
    result.nodes = device.makeBuffer("nodes", std::span<const gpu::Node>(nodes));
    result.voxel_attributes = gathered(device, octree.voxel_attributes, original_voxels, kSpoiledAttribute);
    result.node_attributes = gathered(device, octree.node_attributes, original_nodes, kSpoiledAttribute);
    gatherEmission(device, octree, original_voxels, result);
    result.emission_scale = octree.emission_scale;
    return result;
}

} // namespace zvo::test
