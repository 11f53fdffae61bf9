// SPDX-License-Identifier: MIT
#include "runtime/trees.h"

#include "core/attributes/attribute_pack.h"
#include "core/tree/leaf_words.h"
#include "runtime/run_job.h"
#include "zvo/error.h"

#include <utility>

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
}

} // namespace

BuildResult buildOctree(vk::HeadlessDevice& device, const PosedGpuScene& scene, const GridTile& tile,
                        const BuildOptions& options)
{
    return runJob(device, OctreeBuilder(device.device(), scene, tile, options));
}

CompressResult compress(vk::HeadlessDevice& device, DeviceTree source, const CompressOptions& options)
{
    return runJob(device, SvdagBuilder(device.device(), std::move(source), options));
}

TreeData compressTree(vk::HeadlessDevice& device, TreeData octree)
{
    const CompressOptions options = {.ranks = octree.hasAttributes()};
    TreeData attributes;
    attributes.voxel_attributes = std::exchange(octree.voxel_attributes, {});
    attributes.packed.voxels = std::exchange(octree.packed.voxels, {});
    attributes.emission_words = std::exchange(octree.emission_words, {});
    attributes.emission = std::exchange(octree.emission, {});

    DeviceTree uploaded = uploadTree(device, octree);
    octree = {};
    TreeData dag = downloadTree(device, compress(device, std::move(uploaded), options).dag);
    dag.voxel_attributes = std::move(attributes.voxel_attributes);
    dag.packed.voxels = std::move(attributes.packed.voxels);
    dag.emission_words = std::move(attributes.emission_words);
    dag.emission = std::move(attributes.emission);
    return dag;
}

std::vector<vk::PassTime> packTree(vk::HeadlessDevice& device, AttributeFormat format, DeviceTree& tree)
{
    return runJob(device, TreePacker(device.device(), format, tree));
}

TreeData downloadTree(vk::HeadlessDevice& device, const DeviceTree& tree)
{
    requireAsBuilt(tree);
    TreeData data;
    data.structure = tree.structure;
    data.grid = tree.grid;
    data.voxel_count = tree.voxel_count;
    data.octree_node_count = tree.octreeNodeCount();
    data.long_entry_count = tree.lists.long_entry_count - tree.fullEntries();
    data.levels = tree.levels;
    setNodes(device.download(tree.nodes), tree, data);
    data.before = device.download(tree.lists.before);
    data.before.erase(data.before.begin(),
                      data.before.begin() + std::min<std::ptrdiff_t>(tree.fullEntries(), std::ssize(data.before)));
    data.voxels_before_leaf = device.download(tree.lists.voxels_before_leaf);
    data.voxel_attributes = device.download(tree.voxel_attributes);
    data.node_attributes = device.download(tree.node_attributes);
    data.packed = {tree.packed.format, device.download(tree.packed.voxels), device.download(tree.packed.nodes)};
    data.emission_words = device.download(tree.emission_words);
    data.emission = device.download(tree.emission);
    data.emission_scale = tree.emission_scale;
    return data;
}

std::vector<std::uint64_t> voxelCodes(vk::HeadlessDevice& device, const DeviceTree& octree)
{
    TreeData nodes;
    nodes.levels = octree.levels;
    setNodes(device.download(octree.nodes), octree, nodes);
    std::vector<std::uint64_t> codes;
    codes.reserve(octree.voxel_count);
    forEachVoxel(nodes, [&](std::uint64_t code) { codes.push_back(code); });
    return codes;
}

} // namespace zvo
