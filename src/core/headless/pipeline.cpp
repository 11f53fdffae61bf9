// SPDX-License-Identifier: MIT
#include "core/headless/pipeline.h"

#include "core/headless/run_job.h"

#include <bit>
#include <utility>

namespace zvo
{

BuildResult buildOctree(vk::HeadlessDevice& device, const PosedGpuScene& scene, const GridTile& tile,
                        const BuildOptions& options)
{
    return runJob(device, OctreeBuilder(device.device(), scene, tile, options));
}

std::vector<std::uint64_t> voxelCodes(vk::HeadlessDevice& device, const DeviceTree& octree)
{
    const std::vector<gpu::Node> nodes = device.download(octree.nodes);
    std::vector<std::uint64_t> codes = {0}; // of the nodes of a level, in their order
    for (const DeviceTree::Level& level : octree.levels)
    {
        std::vector<std::uint64_t> children;
        for (std::uint32_t i = 0; i < level.node_count; ++i)
        {
            const gpu::Node& node = nodes[level.first_node + i];
            const std::uint64_t mask = node.mask_lo | std::uint64_t{node.mask_hi} << 32;
            for (std::uint64_t rest = mask; rest != 0; rest &= rest - 1)
            {
                children.push_back(codes[i] << kCellBits | static_cast<std::uint64_t>(std::countr_zero(rest)));
            }
        }
        codes = std::move(children);
    }
    return octree.levels.empty() ? std::vector<std::uint64_t>{} : codes;
}

} // namespace zvo
