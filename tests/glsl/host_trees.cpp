// SPDX-License-Identifier: MIT
#include "glsl/host_trees.h"

#include "core/tree/tree_table.h"
#include "glsl/host_device.h"
#include "runtime/trees.h"
#include "support/dags.h"

#include <vector>

namespace zvo::test
{

DeviceTree octreeWith(const CodeSet& set, AttributeFormat format)
{
    DeviceTree octree = octreeOf(deviceOfHosts(), set.codes, set.depth);
    if (format != AttributeFormat::None)
    {
        addAttributes(deviceOfHosts(), octree);
        octree.emission_scale = 3.5F;
        packTree(deviceOfHosts(), format, octree);
    }
    return octree;
}

DeviceTree dagWith(const CodeSet& set, AttributeFormat format, std::uint32_t entries_per_word)
{
    const DeviceTree octree =
        octreeWith(set, format == AttributeFormat::None ? AttributeFormat::None : AttributeFormat::Bytes8);
    DeviceTree dag = svdagOf(deviceOfHosts(), octree, entries_per_word);
    packTree(deviceOfHosts(), format, dag);
    return dag;
}

vk::BufferOf<gpu::TreeTable> tableOf(const DeviceTree& tree)
{
    return deviceOfHosts().makeBuffer<gpu::TreeTable>("tree table", std::vector{treeTable(tree)});
}

void readTree(vk::AnyPass& pass, const DeviceTree& tree)
{
    pass.read(tree.nodes);
    pass.read(tree.voxel_attributes);
    pass.read(tree.node_attributes);
    pass.read(tree.packed.voxels);
    pass.read(tree.packed.nodes);
    pass.read(tree.emission_words);
    pass.read(tree.emission);
    pass.read(tree.lists.before);
    pass.read(tree.lists.voxels_before_leaf);
    pass.read(tree.overlays.ranks);
}

} // namespace zvo::test
