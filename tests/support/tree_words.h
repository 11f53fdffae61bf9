// SPDX-License-Identifier: MIT
// The contents of trees in device memory, word by word, for tests of what must not change.
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace zvo::test
{

/// Appends the words of `count` elements of a buffer, from element first on. The buffer may be empty if count is 0.
template <typename T>
void addWords(std::vector<gpu::uint>& words, vk::HeadlessDevice& device, const vk::BufferOf<T>& buffer,
              std::uint64_t first, std::uint64_t count)
{
    const std::vector<T> values = count != 0 ? device.download(buffer, first, count) : std::vector<T>();
    const auto* begin = reinterpret_cast<const gpu::uint*>(values.data());
    words.insert(words.end(), begin, begin + values.size() * sizeof(T) / sizeof(gpu::uint));
}

/// The static part of a tree with room for overlays, without the slot of the root that is shown. node_end: the end of
/// the static nodes and lists. emissive_count: static voxels that emit.
inline std::vector<gpu::uint> staticWords(vk::HeadlessDevice& device, const DeviceTree& tree, std::uint64_t node_end,
                                          std::uint64_t emissive_count)
{
    std::vector<gpu::uint> words;
    const auto below_root = [](std::uint64_t count) { return std::max<std::uint64_t>(count, 1) - 1; };
    addWords(words, device, tree.nodes, 1, below_root(node_end));
    if (tree.hasAttributes())
    {
        addWords(words, device, tree.node_attributes, 1, below_root(tree.octreeNodeCount()));
        addWords(words, device, tree.voxel_attributes, 0, tree.voxel_count);
    }
    addWords(words, device, tree.lists.before, 0, tree.lists.before.count());
    addWords(words, device, tree.lists.voxels_before_leaf, 0, tree.lists.voxels_before_leaf.count());
    if (emissive_count != 0)
    {
        addWords(words, device, tree.emission_words, 0, (tree.voxel_count + 31) / 32);
        addWords(words, device, tree.emission, 0, emissive_count);
    }
    return words;
}

} // namespace zvo::test
