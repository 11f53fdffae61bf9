// SPDX-License-Identifier: MIT
#include "core/headless/compress.h"

#include "core/headless/run_job.h"
#include "core/headless/tree_download.h"

#include <utility>

namespace zvo
{

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

} // namespace zvo
