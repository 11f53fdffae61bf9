// SPDX-License-Identifier: MIT
#include "core/radiance/radiance_view.h"

#include "core/base/divide_up.h"
#include "core/tree/tree_table.h"

#include <utility>

namespace zvo
{

/// What a frame of the picture is made of.
struct RadianceView::Work
{
    const DeviceRadianceCache& cache;
    const DeviceTree& tree;
    const DeviceEnvironment& environment;
    const TraceCamera& camera;
    const TraceBuffers& seen;
    CacheView kind;
    bool begins; // sets the sums
};

RadianceView::RadianceView(vk::Device& device, std::uint32_t width, std::uint32_t height)
    : m_width(width), m_height(height), m_sums(device, "radiance/picture", std::uint64_t{width} * height),
      m_direct(device, "radiance/direct", std::uint64_t{width} * height),
      m_lists(device, "radiance/direct_lists", gpu::kListElements)
{
}

void RadianceView::add(vk::FrameGraph& graph, const DeviceRadianceCache& cache, const DeviceTree& tree,
                       const DeviceEnvironment& environment, const TraceCamera& camera, const TraceBuffers& seen,
                       CacheView kind, std::uint32_t seed)
{
    const std::uint32_t frame = std::exchange(m_frame_count, 0); // should anything below throw
    const Work work = {cache, tree, environment, camera, seen, kind, frame == 0};
    graph.fill(m_lists, 0);
    addCached(graph, work);
    for (std::uint32_t cone = 0; kind == CacheView::Cones && cone < gpu::kDiffuseCones; ++cone)
    {
        addCone(graph, work, cone, seed);
    }
    addDirect(graph, work);
    m_frame_count = frame + 1;
}

// Records the pass that lists pixels which see light directly, and adds what the others reflect, unless cones do.
void RadianceView::addCached(vk::FrameGraph& graph, const Work& work)
{
    const bool emits = hasEmission(work.tree);
    vk::Pass pass = graph.addPass(gpu::radiance::View{
        .node_levels = work.tree.grid.nodeLevels(),
        .orthographic = work.camera.orthographic,
        .format = work.tree.attributeFormat(),
        .emission = emits,
        .reflects = work.kind != CacheView::Cones,
        .adds = !work.begins,
        .smooth_normals = work.kind == CacheView::Smooth && work.tree.attributeFormat() != AttributeFormat::None});
    pass.dispatch(m_sums.count(), {.faces = pass.read(work.cache.faces()),
                                   .hits = pass.read(work.seen.hits),
                                   .starts = pass.read(work.seen.starts),
                                   .attributes = readVoxelAttributes(pass, work.tree),
                                   .emission_words = pass.readIf(emits, work.tree.emission_words),
                                   .sums = pass.readWrite(m_sums),
                                   .lists = pass.readWrite(m_lists),
                                   .direct = pass.readWrite(m_direct),
                                   .camera = work.camera.rays,
                                   .width = m_width,
                                   .height = m_height,
                                   .run_count = work.cache.runCount()});
}

// Records the pass that adds what pixels reflect of the light through a cone.
void RadianceView::addCone(vk::FrameGraph& graph, const Work& work, std::uint32_t cone, std::uint32_t seed)
{
    vk::Pass pass = graph.addPass(gpu::radiance::Cones{.node_levels = work.tree.grid.nodeLevels(),
                                                       .entries_per_word = work.tree.entriesPerWord(),
                                                       .orthographic = work.camera.orthographic});
    gpu::RadianceConesParams params{};
    params.tree = readTree(pass, work.tree, work.cache.treeTable());
    readVoxelAttributes(pass, work.tree);
    params.faces = pass.read(work.cache.faces());
    params.environment = work.environment.read(pass);
    params.hits = pass.read(work.seen.hits);
    params.starts = pass.read(work.seen.starts);
    params.sums = pass.readWrite(m_sums);
    params.camera = work.camera.rays;
    params.width = m_width;
    params.height = m_height;
    params.run_count = work.cache.runCount();
    params.cone = cone;
    params.frame = work.cache.frameCount();
    params.seed = seed;
    pass.dispatch(m_sums.count(), params);
}

// Records the pass that adds the light of pixels which see it directly.
void RadianceView::addDirect(vk::FrameGraph& graph, const Work& work)
{
    const bool emits = hasEmission(work.tree);
    vk::Pass pass = graph.addPass(gpu::radiance::Direct{.orthographic = work.camera.orthographic, .emission = emits});
    gpu::RadianceDirectParams params{};
    params.hits = pass.read(work.seen.hits);
    params.starts = pass.read(work.seen.starts);
    if (emits)
    {
        params.tree = pass.read(work.cache.treeTable());
        pass.read(work.tree.emission_words);
        pass.read(work.tree.emission);
    }
    params.environment = work.environment.read(pass);
    params.sums = pass.readWrite(m_sums);
    params.lists = pass.readWrite(m_lists);
    params.direct = pass.read(m_direct);
    params.forward = work.camera.rays.forward;
    params.half_pixel_x = work.camera.rays.half_pixel_x;
    params.half_pixel_y = work.camera.rays.half_pixel_y;
    params.width = m_width;
    params.height = m_height;
    pass.dispatchIndirect(m_lists, listArgs(0, gpu::kListMisses), params, divideUp(m_sums.count(), gpu::kPathGroup));
}

} // namespace zvo
