// SPDX-License-Identifier: MIT
#include "core/headless/tree_download.h"

#include "zvo/error.h"

namespace zvo
{

namespace
{

void requireAsBuilt(const DeviceTree& tree)
{
    const bool has_levels = tree.levels.empty() == (tree.node_count == 0);
    if (!has_levels || tree.nodes.count() != tree.packing().poolNodes())
    {
        throw Error(ErrorCode::Usage, "a tree that something was merged into cannot be copied to the host; rebuild it");
    }
    const ListPacking tightest = ListPacking::tightest(tree.node_count, tree.lists.entry_count);
    if (tree.lists.entry_count != 0 && tree.lists.entries_per_word != tightest.per_word)
    {
        throw Error(ErrorCode::Usage, "a DAG whose words have fewer entries than they could cannot be copied to the "
                                      "host; compress it without that option");
    }
}

} // namespace

TreeData downloadTree(vk::HeadlessDevice& device, const DeviceTree& tree)
{
    requireAsBuilt(tree);
    TreeData data;
    data.structure = tree.structure;
    data.grid = tree.grid;
    data.voxel_count = tree.voxel_count;
    data.octree_node_count = tree.octreeNodeCount();
    data.long_entry_count = tree.lists.long_entry_count;
    data.levels = tree.levels;
    data.nodes = device.download(tree.nodes, 0, tree.node_count);
    data.lists = nodesToEntries(device.download(tree.nodes, tree.node_count), tree.packing());
    data.before = device.download(tree.lists.before);
    data.voxels_before_leaf = device.download(tree.lists.voxels_before_leaf);
    data.voxel_attributes = device.download(tree.voxel_attributes);
    data.node_attributes = device.download(tree.node_attributes);
    data.packed = {tree.packed.format, device.download(tree.packed.voxels), device.download(tree.packed.nodes)};
    data.emission_words = device.download(tree.emission_words);
    data.emission = device.download(tree.emission);
    data.emission_scale = tree.emission_scale;
    return data;
}

} // namespace zvo
