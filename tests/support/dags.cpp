// SPDX-License-Identifier: MIT
#include "support/dags.h"

#include "support/octree_access.h"

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

oracle::ReferenceDag referenceDagOf(vk::HeadlessDevice& device, const Octree& octree, std::uint32_t entries_per_word)
{
    return oracle::referenceDag(device.download(octree.nodes), levelsOf(octree), entries_per_word);
}

Svdag svdagOf(vk::HeadlessDevice& device, const Octree& octree, std::uint32_t entries_per_word)
{
    return svdagOf(device, octree, referenceDagOf(device, octree, entries_per_word));
}

Svdag svdagOf(vk::HeadlessDevice& device, const Octree& octree, const oracle::ReferenceDag& reference)
{
    Svdag dag;
    dag.octree_node_count = octree.node_count;
    dag.entry_count = reference.entry_count;
    dag.long_entry_count = reference.long_entry_count;
    dag.tree.grid = octree.grid;
    dag.tree.node_count = reference.node_count;
    dag.tree.voxel_count = octree.voxel_count;
    dag.tree.emission_scale = octree.emission_scale;
    for (const oracle::NodeRange& range : reference.levels)
    {
        dag.tree.levels.push_back({range.first_node, range.node_count});
    }
    dag.entries_per_word = reference.entries_per_word;
    dag.tree.nodes = device.makeBuffer("pool", std::span(reference.pool));
    dag.tree.voxel_attributes = copyOf(device, octree.voxel_attributes);
    dag.tree.emission_words = copyOf(device, octree.emission_words);
    dag.tree.emission = copyOf(device, octree.emission);
    if (octree.node_attributes.count() != 0)
    {
        const std::vector<gpu::Attribute> attributes = device.download(octree.node_attributes);
        std::vector<gpu::Attribute> depth_first;
        for (const std::uint32_t node : reference.depth_first)
        {
            depth_first.push_back(attributes.at(node));
        }
        dag.tree.node_attributes = device.makeBuffer("node attributes", std::span<const gpu::Attribute>(depth_first));
    }
    if (octree.hasAttributes())
    {
        dag.before = device.makeBuffer("before", std::span(reference.before));
        dag.voxels_before_leaf = device.makeBuffer("voxels before leaf", std::span(reference.voxels_before_leaf));
    }
    return dag;
}

oracle::DagContents contentsOf(vk::HeadlessDevice& device, const Svdag& dag)
{
    const std::vector<gpu::BeforeChild> before = device.download(dag.before);
    const std::vector<gpu::uint> voxels_before_leaf = device.download(dag.voxels_before_leaf);
    return oracle::expandDag(device.download(dag.tree.nodes), levelsOf(dag.tree), dag.entry_count, dag.long_entry_count,
                             before, voxels_before_leaf, dag.entries_per_word);
}

} // namespace zvo::test
