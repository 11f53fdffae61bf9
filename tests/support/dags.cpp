// SPDX-License-Identifier: MIT
#include "support/dags.h"

#include "support/octree_access.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

namespace zvo::test
{

namespace
{

template <typename T> vk::BufferOf<T> copyOf(vk::HeadlessDevice& device, const vk::BufferOf<T>& buffer)
{
    const std::vector<T> values = device.download(buffer);
    return device.makeBuffer(buffer.name(), std::span<const T>(values));
}

} // namespace

oracle::ReferenceDag referenceDagOf(vk::HeadlessDevice& device, const DeviceTree& octree)
{
    return oracle::referenceDag(octreeNodes(device, octree), levelsOf(octree));
}

DeviceTree svdagOf(vk::HeadlessDevice& device, const DeviceTree& octree, std::uint32_t entries_per_word)
{
    return svdagOf(device, octree, referenceDagOf(device, octree), entries_per_word);
}

DeviceTree svdagOf(vk::HeadlessDevice& device, const DeviceTree& octree, const oracle::ReferenceDag& reference,
                   std::uint32_t entries_per_word)
{
    const oracle::LeafWordPool pool = oracle::leafWordPool(reference, entries_per_word);
    DeviceTree dag;
    dag.lists.octree_node_count = octree.node_count;
    dag.lists.entry_count = reference.entry_count;
    dag.lists.long_entry_count = reference.long_entry_count;
    dag.structure = TreeStructure::Svdag;
    dag.grid = octree.grid;
    dag.node_count = reference.node_count;
    dag.voxel_count = octree.voxel_count;
    dag.emission_scale = octree.emission_scale;
    for (const oracle::NodeRange& range : reference.levels)
    {
        dag.levels.push_back({range.first_node, range.node_count});
    }
    dag.leaf_words = pool.leaf_words;
    dag.lists.entries_per_word = pool.entries_per_word;
    dag.nodes = device.makeBuffer("pool", std::span(pool.nodes));
    dag.voxel_attributes = copyOf(device, octree.voxel_attributes);
    dag.emission_words = copyOf(device, octree.emission_words);
    dag.emission = copyOf(device, octree.emission);
    if (octree.node_attributes.count() != 0)
    {
        const std::vector<gpu::Attribute> attributes = device.download(octree.node_attributes);
        std::vector<gpu::Attribute> depth_first;
        for (const std::uint32_t node : reference.depth_first)
        {
            depth_first.push_back(attributes.at(node));
        }
        dag.node_attributes = device.makeBuffer("node attributes", std::span<const gpu::Attribute>(depth_first));
    }
    if (octree.hasAttributes())
    {
        dag.lists.before = device.makeBuffer("before", std::span(reference.before));
        dag.lists.voxels_before_leaf = device.makeBuffer("voxels before leaf", std::span(reference.voxels_before_leaf));
    }
    return dag;
}

oracle::DagContents dagContentsOf(vk::HeadlessDevice& device, const DeviceTree& dag)
{
    const std::vector<gpu::BeforeChild> before = device.download(dag.lists.before);
    const std::vector<gpu::uint> voxels_before_leaf = device.download(dag.lists.voxels_before_leaf);
    TreeData data;
    data.structure = dag.structure;
    data.levels = dag.levels;
    data.long_entry_count = dag.lists.long_entry_count;
    setNodes(device.download(dag.nodes), dag, data);
    std::vector<gpu::Node> pool = data.nodes;
    std::ranges::copy(nodesOf(packEntries(data.lists, data.packing().per_word)), std::back_inserter(pool));
    return oracle::expandDag(pool, levelsOf(dag), dag.lists.entry_count, dag.lists.long_entry_count, before,
                             voxels_before_leaf, data.packing().per_word);
}

} // namespace zvo::test
