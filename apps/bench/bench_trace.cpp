// SPDX-License-Identifier: MIT
#include "bench/bench_trace.h"

#include "bench/bench_runs.h"

#include <utility>

namespace zvo::cli
{

PrimaryRays::PrimaryRays(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera,
                         TreeTracer& tracer)
    : m_device(device), m_tree(tree), m_camera(camera), m_tracer(tracer), m_node_paths_ms(prepare())
{
    trace();
}

double PrimaryRays::prepare()
{
    return sumMs(m_device.run([&](vk::FrameGraph& graph) { m_tracer.prepare(graph, m_tree); }));
}

std::vector<vk::PassTime> PrimaryRays::trace()
{
    prepare();
    return m_device.run([&](vk::FrameGraph& graph) { m_tracer.tracePrimary(graph, m_tree, m_camera, TraceOptions{}); });
}

namespace
{

// Traces a picture; adds its time and its part of the sums.
void addPicture(PrimaryRays& rays, std::uint32_t turn_count, std::vector<double>& ms, std::vector<vk::PassTime>& sums)
{
    std::vector<vk::PassTime> passes = rays.trace();
    ms.push_back(sumMs(passes));
    addPasses(sums, std::move(passes), turn_count);
}

} // namespace

TraceRuns traceAlone(PrimaryRays& octree, std::uint32_t turn_count)
{
    TraceRuns runs;
    std::vector<double> octree_ms;
    for (std::uint32_t turn = 0; turn < turn_count; ++turn)
    {
        addPicture(octree, turn_count, octree_ms, runs.octree_passes);
    }
    runs.octree_ms = Spread::of(octree_ms);
    return runs;
}

TraceRuns traceInTurns(PrimaryRays& octree, PrimaryRays& dag, std::uint32_t turn_count)
{
    TraceRuns runs;
    std::vector<double> octree_ms;
    std::vector<double> dag_ms;
    std::vector<double> ratios;
    for (std::uint32_t turn = 0; turn < turn_count; ++turn)
    {
        const bool dag_first = turn % 2 != 0;
        if (dag_first)
        {
            addPicture(dag, turn_count, dag_ms, runs.dag_passes);
        }
        addPicture(octree, turn_count, octree_ms, runs.octree_passes);
        if (!dag_first)
        {
            addPicture(dag, turn_count, dag_ms, runs.dag_passes);
        }
        ratios.push_back(octree_ms.back() > 0 ? dag_ms.back() / octree_ms.back() : 0.0);
    }
    runs.octree_ms = Spread::of(octree_ms);
    runs.dag_ms = Spread::of(dag_ms);
    runs.ratio = Spread::of(ratios);
    return runs;
}

std::uint64_t countHits(vk::HeadlessDevice& device, const TraceBuffers& buffers)
{
    const std::vector<gpu::Hit> hits = device.download(buffers.hits);
    const std::vector<float> starts = device.download(buffers.starts);
    const std::uint32_t tiles_x = (buffers.width + gpu::kTileEdge - 1) / gpu::kTileEdge;
    std::uint64_t count = 0;
    for (std::size_t pixel = 0; pixel < hits.size(); ++pixel)
    {
        const std::size_t tile =
            pixel / buffers.width / gpu::kTileEdge * tiles_x + pixel % buffers.width / gpu::kTileEdge;
        count += starts[tile] != gpu::kTileDead && hits[pixel].index != gpu::kHitMiss ? 1 : 0;
    }
    return count;
}

} // namespace zvo::cli
