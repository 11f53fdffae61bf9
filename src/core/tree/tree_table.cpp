// SPDX-License-Identifier: MIT
#include "core/tree/tree_table.h"

namespace zvo
{

namespace
{

void setAttributes(const DeviceTree& octree, gpu::TreeTable& table)
{
    const bool packed = isPacked(octree.attributeFormat());
    table.attribute_format = static_cast<gpu::uint>(octree.attributeFormat());
    table.attributes = {packed ? octree.packed.voxels.address() : octree.voxel_attributes.address()};
    table.node_attributes = {packed ? octree.packed.nodes.address() : octree.node_attributes.address()};
    if (octree.hasAttributes() && octree.emission.count() != 0)
    {
        table.emission_words = {octree.emission_words.address()};
        table.emission = {octree.emission.address()};
    }
    table.emission_scale = octree.emission_scale;
}

} // namespace

gpu::TreeTable treeTable(const DeviceTree& tree)
{
    gpu::TreeTable table{};
    table.source = rankSource(tree);
    table.entries_per_word = tree.entriesPerWord();
    setAttributes(tree, table);
    if (tree.overlays.hasRanks())
    {
        table.overlay_ranks = {tree.overlays.ranks.address() - tree.overlays.ranksSkipped()};
        table.attribute_offset = tree.attributeOffset();
    }
    // Of nodes, the static root's is behind the static ones (DeviceTree::node_attributes).
    table.first_dynamic_voxel = tree.voxel_count;
    table.first_dynamic_node = tree.octreeNodeCount() + 1;
    table.depth = tree.grid.depth;
    table.node_levels = tree.grid.nodeLevels();
    table.origin = tree.grid.origin;
    table.voxel_size = tree.grid.voxel_size;
    return table;
}

gpu::ConstPtr<gpu::TreeTable> readTree(vk::AnyPass& pass, const DeviceTree& tree,
                                       const vk::BufferOf<gpu::TreeTable>& table)
{
    rankSource(pass, tree);
    pass.read(tree.emission_words);
    pass.read(tree.emission);
    pass.read(tree.node_attributes);
    pass.read(tree.packed.nodes);
    if (tree.overlays.hasRanks())
    {
        pass.read(tree.overlays.ranks);
    }
    return pass.read(table);
}

} // namespace zvo
