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
    TreeData looks;
    looks.voxel_attributes = std::exchange(octree.voxel_attributes, {});
    looks.packed.voxels = std::exchange(octree.packed.voxels, {});
    looks.emission_words = std::exchange(octree.emission_words, {});
    looks.emission = std::exchange(octree.emission, {});

    DeviceTree uploaded = uploadTree(device, octree);
    octree = {};
    TreeData dag = downloadTree(device, compress(device, std::move(uploaded), options).dag);
    dag.voxel_attributes = std::move(looks.voxel_attributes);
    dag.packed.voxels = std::move(looks.packed.voxels);
    dag.emission_words = std::move(looks.emission_words);
    dag.emission = std::move(looks.emission);
    return dag;
}

} // namespace zvo
