// SPDX-License-Identifier: MIT
#include "core/headless/tree_download.h"

#include "zvo/error.h"

namespace zvo
{

namespace
{

void requireAsBuilt(const Octree& octree, std::uint64_t pool_nodes)
{
    const bool has_levels = octree.levels.empty() == (octree.node_count == 0);
    if (!has_levels || octree.nodes.count() != pool_nodes)
    {
        throw Error(ErrorCode::Usage, "a tree that something was merged into cannot be copied to the host; rebuild it");
    }
}

// What octrees and DAGs have in common.
TreeData downloadCommon(vk::HeadlessDevice& device, const Octree& octree)
{
    TreeData tree;
    tree.grid = octree.grid;
    tree.voxel_count = octree.voxel_count;
    tree.levels = octree.levels;
    tree.nodes = device.download(octree.nodes, 0, octree.node_count);
    tree.voxel_attributes = device.download(octree.voxel_attributes);
    tree.node_attributes = device.download(octree.node_attributes);
    tree.packed = {octree.packed.form, device.download(octree.packed.voxels), device.download(octree.packed.nodes)};
    tree.emission_words = device.download(octree.emission_words);
    tree.emission = device.download(octree.emission);
    tree.emission_scale = octree.emission_scale;
    return tree;
}

} // namespace

TreeData downloadTree(vk::HeadlessDevice& device, const Octree& octree)
{
    requireAsBuilt(octree, octree.node_count);
    TreeData tree = downloadCommon(device, octree);
    tree.octree_node_count = octree.node_count;
    return tree;
}

TreeData downloadTree(vk::HeadlessDevice& device, const Svdag& dag)
{
    requireAsBuilt(dag.tree, dag.packing().poolNodes());
    const ListPacking tightest = ListPacking::tightest(dag.tree.node_count, dag.entry_count);
    if (dag.entry_count != 0 && dag.entries_per_word != tightest.per_word)
    {
        throw Error(ErrorCode::Usage, "a DAG whose words have fewer entries than they could cannot be copied to the "
                                      "host; compress it without that option");
    }
    TreeData tree = downloadCommon(device, dag.tree);
    tree.structure = TreeStructure::Svdag;
    tree.octree_node_count = dag.octree_node_count;
    tree.long_entry_count = dag.long_entry_count;
    tree.lists = nodesToEntries(device.download(dag.tree.nodes, dag.tree.node_count), dag.packing());
    tree.before = device.download(dag.before);
    tree.voxels_before_leaf = device.download(dag.voxels_before_leaf);
    return tree;
}

} // namespace zvo
