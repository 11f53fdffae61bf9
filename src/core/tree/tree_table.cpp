// SPDX-License-Identifier: MIT
#include "core/tree/tree_table.h"

namespace zvo
{

namespace
{

void setAttributes(const Octree& octree, gpu::TreeTable& table)
{
    const bool packed = isPacked(octree.attributeForm());
    table.attribute_form = static_cast<gpu::uint>(octree.attributeForm());
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

gpu::TreeTable treeTable(const TreeView& tree)
{
    const Octree& octree = tree.octree();
    gpu::TreeTable table{};
    table.source.pool = {octree.nodes.address()};
    table.entries_per_word = tree.entriesPerWord();
    setAttributes(octree, table);
    std::uint32_t static_node_count = octree.node_count;
    if (const Svdag* dag = tree.svdag())
    {
        static_node_count = dag->octree_node_count;
        table.source = rankSource(*dag);
    }
    const OverlaidTree* overlaid = tree.overlaid();
    if (overlaid != nullptr && overlaid->hasRanks())
    {
        table.overlay_ranks = {overlaid->ranks.address() - overlaid->ranksSkipped()};
        table.attribute_offset = overlaid->attributeOffset();
    }
    // Of nodes, the static root's is behind the static ones (core/tree/overlaid_tree.h).
    table.first_dynamic_voxel = octree.voxel_count;
    table.first_dynamic_node = static_node_count + 1;
    table.depth = octree.grid.depth;
    table.node_levels = octree.grid.nodeLevels();
    table.origin = octree.grid.origin;
    table.voxel_size = octree.grid.voxel_size;
    return table;
}

} // namespace zvo
