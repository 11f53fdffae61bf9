// SPDX-License-Identifier: MIT
#include "support/tree_probe.h"

#include "core/file/tree_stats.h"
#include "core/scene/camera.h"
#include "core/tree/device_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace zvo::test
{

namespace
{

constexpr std::uint32_t kPictureEdge = 16; // pixels
constexpr std::uint32_t kRayCount = 64;

std::vector<gpu::Ray> someRays(std::mt19937& random)
{
    std::uniform_real_distribution<float> position(0.5F, 2.5F);
    std::uniform_real_distribution<float> direction(-1.0F, 1.0F);
    std::vector<gpu::Ray> rays(kRayCount);
    for (gpu::Ray& ray : rays)
    {
        ray.origin = {position(random), position(random), position(random)};
        ray.t_min = 0.0F;
        ray.inverse_direction = 1.0F / glm::vec3(direction(random), direction(random), direction(random));
        ray.t_max = INFINITY;
    }
    return rays;
}

} // namespace

std::string walkFault(const TreeData& tree)
{
    std::uint64_t count = 0;
    std::uint64_t next = 0;
    bool is_sound = true;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     is_sound = is_sound && code >= next && code >> (3 * tree.grid.depth) == 0;
                     next = code + 1;
                     ++count;
                 });
    const TreeStats stats = treeStats(tree);
    return !is_sound                                             ? "voxels out of order or outside"
           : count != tree.voxel_count                           ? "other voxels than are counted"
           : stats.binary_unique_count > stats.binary_node_count ? "more different nodes than nodes"
                                                                 : "";
}

TreeProbe::TreeProbe(vk::HeadlessDevice& device)
    : m_device(device), m_octree_paths(device.device()), m_dag_paths(device.device(), true),
      m_picture(device.device(), kPictureEdge, kPictureEdge), m_rays(device.device(), "rays", kRayCount),
      m_hits(device.device(), "hits", kRayCount), m_rounds(device.device(), "rounds", gpu::kTraceRoundsMax),
      m_status(device.device(), "status", 1)
{
}

std::string TreeProbe::traceFault(const TreeData& tree, std::mt19937& random)
{
    const DeviceTree view = uploadTree(m_device, tree);
    TraceOptions options;
    options.beam = random() % 2 == 0;
    options.occlusion_rays = random() % 2;
    options.detail_pixels = random() % 3 == 0 ? 4.0F : 0.0F;
    const Bounds all = {tree.grid.origin,
                        tree.grid.origin + tree.grid.voxel_size * static_cast<float>(tree.grid.resolution())};
    const TraceCamera camera = traceCamera(ViewCamera::framing(all, 1.0), tree.grid, kPictureEdge);
    m_device.upload<gpu::Ray>(m_rays, someRays(random));
    NodePaths& paths = options.beam && view.isDag() ? m_dag_paths : m_octree_paths;
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            if (options.beam)
            {
                buildNodePaths(graph, view, paths);
            }
            trace(graph, view, paths, camera, options, m_picture);
            graph.fill(m_status, 0);
            traceRays(graph, view, m_rays, m_hits, m_rounds, m_status, TraceOptions());
        });
    if (m_device.download(m_status).front().capped_rays != 0 ||
        m_device.download(m_picture.status).front().capped_rays != 0)
    {
        return "a ray that does not end";
    }
    const std::vector<gpu::Hit> hits = m_device.download(m_hits);
    const bool is_sound =
        std::all_of(hits.begin(), hits.end(),
                    [&](const gpu::Hit& hit)
                    { return hit.index == gpu::kHitMiss || hit.index < tree.voxel_count || !tree.hasAttributes(); });
    return is_sound ? "" : "a hit on a voxel that is not there";
}

} // namespace zvo::test
