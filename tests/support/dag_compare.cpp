// SPDX-License-Identifier: MIT
#include "support/dag_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace zvo::test
{

namespace
{

template <typename T>
std::string bufferDifference(vk::HeadlessDevice& device, const vk::BufferOf<T>& actual, const vk::BufferOf<T>& expected,
                             const char* what)
{
    const std::vector<T> a = device.download(actual);
    const std::vector<T> b = device.download(expected);
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    {
        if (std::memcmp(&a[i], &b[i], sizeof(T)) != 0)
        {
            return fmt::format("{} differ from element {} of {} on", what, i, b.size());
        }
    }
    return a.size() == b.size() ? "" : fmt::format("{} {} in place of {}", a.size(), what, b.size());
}

std::string numbersOf(const DeviceTree& dag)
{
    const DeviceTree& tree = dag;
    std::string text = fmt::format(
        "depth {} origin {} {} {} voxels of {}, {} voxels, {} nodes for {}, {} entries, {} long, emission of "
        "{}, attributes {}, levels:",
        tree.grid.depth, tree.grid.origin.x, tree.grid.origin.y, tree.grid.origin.z, tree.grid.voxel_size,
        tree.voxel_count, tree.node_count, dag.octreeNodeCount(), dag.lists.entry_count, dag.lists.long_entry_count,
        tree.emission_scale, formatName(tree.attributeFormat()));
    for (const DeviceTree::Level& level : tree.levels)
    {
        text += fmt::format(" {}+{}", level.first_node, level.node_count);
    }
    return text;
}

} // namespace

std::string difference(vk::HeadlessDevice& device, const DeviceTree& actual, const DeviceTree& expected)
{
    if (numbersOf(actual) != numbersOf(expected))
    {
        return numbersOf(actual) + "\nin place of\n" + numbersOf(expected);
    }
    for (const std::string& found :
         {bufferDifference(device, actual.nodes, expected.nodes, "nodes and lists"),
          bufferDifference(device, actual.lists.before, expected.lists.before, "long entries"),
          bufferDifference(device, actual.lists.voxels_before_leaf, expected.lists.voxels_before_leaf,
                           "words of short entries"),
          bufferDifference(device, actual.voxel_attributes, expected.voxel_attributes, "voxel attributes"),
          bufferDifference(device, actual.node_attributes, expected.node_attributes, "node attributes"),
          bufferDifference(device, actual.packed.voxels, expected.packed.voxels, "words of packed voxel attributes"),
          bufferDifference(device, actual.packed.nodes, expected.packed.nodes, "words of packed node attributes"),
          bufferDifference(device, actual.emission_words, expected.emission_words, "emission words"),
          bufferDifference(device, actual.emission, expected.emission, "emissions")})
    {
        if (!found.empty())
        {
            return found;
        }
    }
    return "";
}

} // namespace zvo::test
