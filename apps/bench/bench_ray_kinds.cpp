// SPDX-License-Identifier: MIT
#include "bench/bench_ray_kinds.h"

#include "bench/ray_kinds.h"
#include "core/base/divide_up.h"
#include "core/trace/trace.h"
#include "core/trace/trace_loads.h"
#include "runtime/trees.h"

#ifdef ZVO_EMBREE
#include "bench/bench_embree.h"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr std::size_t kWarp = 32;
constexpr std::size_t kWarps = 1024; // whose loads are noted
constexpr double kSectorBytes = 8.0 * gpu::kSectorWords;

double medianRate(std::vector<double> seconds, std::size_t ray_count)
{
    std::ranges::nth_element(seconds, seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2));
    return static_cast<double>(ray_count) / seconds[seconds.size() / 2] / 1e6;
}

// Warps of neighbours in the list, spread evenly over it.
std::vector<gpu::Ray> someWarps(const std::vector<gpu::Ray>& rays)
{
    const std::size_t warps = divideUp(rays.size(), kWarp);
    const std::size_t taken = std::min(warps, kWarps);
    std::vector<gpu::Ray> some;
    for (std::size_t i = 0; i < taken; ++i)
    {
        const std::size_t first = i * warps / taken * kWarp;
        some.insert(some.end(), rays.begin() + static_cast<std::ptrdiff_t>(first),
                    rays.begin() + static_cast<std::ptrdiff_t>(std::min(first + kWarp, rays.size())));
    }
    return some;
}

using Sectors = std::vector<gpu::uint>;

double countDistinct(Sectors sectors)
{
    std::ranges::sort(sectors);
    return static_cast<double>(std::unique(sectors.begin(), sectors.end()) - sectors.begin());
}

// Sums over warps.
struct LoadSums
{
    double iterations = 0;
    double longest = 0;  // iterations of the longest ray, for each ray of its warp
    double loads = 0;    // of warps
    double of_loads = 0; // distinct sectors
    double of_rays = 0;
    double of_warps = 0;

    // lengths: iterations of each ray; rays: its loads, in their order.
    void addWarp(const std::vector<gpu::uint>& lengths, const std::vector<Sectors>& rays)
    {
        iterations += std::accumulate(lengths.begin(), lengths.end(), 0.0);
        longest += static_cast<double>(std::ranges::max(lengths)) * static_cast<double>(lengths.size());
        Sectors of_warp;
        std::vector<Sectors> by_load(std::ranges::max(rays, {}, &Sectors::size).size());
        for (const Sectors& ray : rays)
        {
            of_rays += countDistinct(ray);
            of_warp.insert(of_warp.end(), ray.begin(), ray.end());
            for (std::size_t load = 0; load < ray.size(); ++load)
            {
                by_load[load].push_back(ray[load]);
            }
        }
        of_warps += countDistinct(of_warp);
        loads += static_cast<double>(by_load.size());
        for (const Sectors& load : by_load)
        {
            of_loads += countDistinct(load);
        }
    }
};

// Traces lists of rays through an octree and, in turns, its DAG, and by Embree.
class KindBench
{
public:
    KindBench(vk::HeadlessDevice& device, const DeviceTree& octree, const DeviceTree* dag,
              const BenchRaysOptions& options)
        : m_device(device), m_octree(octree), m_dag(dag), m_options(options)
    {
#ifdef ZVO_EMBREE
        m_embree.emplace(EmbreeScene::ofVoxels(octree.grid, voxelCodes(device, octree)));
#endif
    }

    // Returns where the rays hit. wanted: whether they make a row.
    std::vector<FacePoint> trace(const std::string& kind, bool wanted, const std::vector<PrimaryRay>& rays)
    {
        if (rays.empty())
        {
            return {};
        }
        std::vector<gpu::Ray> list(rays.size());
        std::ranges::transform(rays, list.begin(), deviceRay);
        const vk::BufferOf<gpu::Ray> buffer = m_device.makeBuffer<gpu::Ray>("bench/rays", list);
        vk::BufferOf<gpu::Hit> hits(m_device.device(), "bench/hits", rays.size());
        traceOnce(m_octree, buffer, hits);
        const std::vector<gpu::Hit> found = m_device.download(hits);
        if (wanted)
        {
            RayKindRow row;
            row.kind = kind;
            row.rays = rays.size();
            row.hits = rays.size() - static_cast<std::uint64_t>(
                                         std::ranges::count(found, gpu::uint{gpu::kHitMiss}, &gpu::Hit::index));
            measureTimes(row, buffer, hits, rays);
            const std::vector<gpu::Ray> some = someWarps(list);
            measureLoads(row, row.octree, m_octree, some);
            if (row.dag)
            {
                measureLoads(row, *row.dag, *m_dag, some);
            }
            m_rows.push_back(std::move(row));
        }
        return facePoints(rays, found);
    }

    std::vector<RayKindRow> takeRows()
    {
        return std::move(m_rows);
    }

private:
    // Returns the seconds of trace/rays alone.
    double traceOnce(const DeviceTree& tree, const vk::BufferOf<gpu::Ray>& rays, vk::BufferOf<gpu::Hit>& hits)
    {
        vk::BufferOf<gpu::DispatchArgs> rounds(m_device.device(), "bench/rounds", gpu::kTraceRoundsMax);
        vk::BufferOf<gpu::TraceStatus> status(m_device.device(), "bench/status", 1);
        double ms = 0;
        for (const vk::PassTime& pass : m_device.run(
                 [&](vk::FrameGraph& graph)
                 {
                     graph.fill(status, 0);
                     traceRays(graph, tree, rays, hits, rounds, status, {});
                 }))
        {
            ms += pass.name == "trace/rays" ? pass.ms : 0.0;
        }
        return ms / 1e3;
    }

    void measureTimes(RayKindRow& row, const vk::BufferOf<gpu::Ray>& rays, vk::BufferOf<gpu::Hit>& hits,
                      [[maybe_unused]] const std::vector<PrimaryRay>& host_rays)
    {
        std::vector<double> octree;
        std::vector<double> dag;
        std::vector<double> embree;
        if (m_dag != nullptr)
        {
            traceOnce(*m_dag, rays, hits);
        }
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            octree.push_back(traceOnce(m_octree, rays, hits));
            if (m_dag != nullptr)
            {
                dag.push_back(traceOnce(*m_dag, rays, hits));
            }
#ifdef ZVO_EMBREE
            const EmbreeRun traced = m_embree->trace(host_rays, 1);
            row.embree_hits = traced.hit_count;
            embree.push_back(traced.seconds);
            row.embree_mrays_per_s = medianRate(embree, row.rays);
#endif
        }
        row.octree.mrays_per_s = medianRate(octree, row.rays);
        if (m_dag != nullptr)
        {
            row.dag.emplace().mrays_per_s = medianRate(dag, row.rays);
        }
    }

    // Fills all but times. The iterations of a tree and its DAG are the same.
    void measureLoads(RayKindRow& row, RaysInTree& in_tree, const DeviceTree& tree, const std::vector<gpu::Ray>& rays)
    {
        RayLoads loads(m_device.device(), rays.size());
        const vk::BufferOf<gpu::Ray> list = m_device.makeBuffer<gpu::Ray>("bench/some rays", rays);
        m_device.run([&](vk::FrameGraph& graph) { traceLoads(graph, tree, list, loads); });
        const std::vector<gpu::uint> iterations = m_device.download(loads.iterations);
        const auto loadsOf = [&](std::uint32_t count)
        { return std::size_t{std::min(count * (tree.isDag() ? 2U : 1U), gpu::kRayLoadsMax)}; };
        const std::vector<gpu::uint> sectors =
            m_device.download(loads.sectors, 0, loadsOf(std::ranges::max(iterations)) * rays.size());
        LoadSums sums;
        for (std::size_t first = 0; first < rays.size(); first += kWarp)
        {
            const auto begin = iterations.begin() + static_cast<std::ptrdiff_t>(first);
            const std::vector<gpu::uint> lengths(begin,
                                                 begin + std::min<std::ptrdiff_t>(kWarp, iterations.end() - begin));
            std::vector<Sectors> warp(lengths.size());
            for (std::size_t i = 0; i < warp.size(); ++i)
            {
                for (std::size_t load = 0; load < loadsOf(lengths[i]); ++load)
                {
                    warp[i].push_back(sectors[load * rays.size() + first + i]);
                }
            }
            sums.addWarp(lengths, warp);
        }
        const auto count = static_cast<double>(rays.size());
        row.iterations = sums.iterations / count;
        row.longest = sums.longest / std::max(sums.iterations, 1.0);
        in_tree.bytes = kSectorBytes * sums.of_rays / count;
        in_tree.warp_bytes = kSectorBytes * sums.of_warps / count;
        in_tree.load_sectors = sums.of_loads / std::max(sums.loads, 1.0);
    }

    vk::HeadlessDevice& m_device;
    const DeviceTree& m_octree;
    const DeviceTree* m_dag;
    const BenchRaysOptions& m_options;
#ifdef ZVO_EMBREE
    std::optional<EmbreeScene> m_embree;
#endif
    std::vector<RayKindRow> m_rows;
};

} // namespace

std::vector<RayKindRow> measureRayKinds(vk::HeadlessDevice& device, const DeviceTree& octree, const DeviceTree* dag,
                                        const TraceCamera& camera, const glm::uvec2& size,
                                        const BenchRaysOptions& options)
{
    constexpr float kFar = std::numeric_limits<float>::infinity();
    constexpr std::uint32_t kBounces = 8;
    const auto wants = [&](const char* kind) {
        return std::ranges::any_of(options.kinds,
                                   [&](const std::string& name) { return name == kind || name == "all"; });
    };
    const Grid& grid = octree.grid;
    const float edge = static_cast<float>(grid.resolution()) / static_cast<float>(grid.rootResolution());
    const TraceOptions usual;
    KindBench bench(device, octree, dag, options);
    const std::vector<FacePoint> seen = bench.trace("primary", wants("primary"), primaryRays(camera, size.x, size.y));
    if (wants("shadow"))
    {
        bench.trace("shadow", true, raysToward(grid, seen, glm::normalize(glm::vec3(usual.to_sun))));
    }
    if (wants("ambient"))
    {
        bench.trace("ambient", true, scatteredRays(grid, seen, usual.occlusion_reach * edge, 0));
    }
    std::vector<FacePoint> points = seen;
    for (std::uint32_t bounce = 1; wants("bounces") && bounce <= kBounces; ++bounce)
    {
        points = bench.trace(fmt::format("bounce {}", bounce), true, scatteredRays(grid, points, kFar, bounce));
    }
    if (wants("random"))
    {
        bench.trace("random", true, raysWithin(glm::vec3(1.0F), glm::vec3(1.0F + edge), size.x * size.y, 0));
    }
    return bench.takeRows();
}

} // namespace zvo::cli
