// SPDX-License-Identifier: MIT
#include "baseline/bit_grid.h"
#include "baseline/hash_dag.h"
#include "bench/baseline_comparisons.h"
#include "bench/bench_embree.h"
#include "bench/primary_rays.h"
#include "core/headless/compress.h"
#include "core/headless/tree_download.h"

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

// Milliseconds that function takes.
template <typename Function> double hostMs(const Function& function)
{
    const auto start = std::chrono::steady_clock::now();
    function();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

#ifdef ZVO_EMBREE
// Milliseconds of a picture at a rate of rays.
double msAt(double mrays_per_s, std::size_t ray_count)
{
    return static_cast<double>(ray_count) / mrays_per_s / 1e3;
}

void compareEmbree(BaselineSubject& subject, std::span<const std::uint64_t> codes, std::span<const PrimaryRay> rays,
                   BaselineRows& rows)
{
    std::vector<double> packets[2];
    std::vector<double> single[2];
    std::vector<double> zvo_ms;
    const auto zvoRays = subject.rays();
    for (std::uint32_t run = 0; run < subject.options().run_count; ++run)
    {
        const EmbreeResult results[] = {traceVoxelsByEmbree(subject.grid(), codes, rays, 1),
                                        traceTrianglesByEmbree(subject.grid(), subject.scene(), rays, 1)};
        for (std::size_t i = 0; i < std::size(results); ++i)
        {
            packets[i].push_back(msAt(results[i].mrays_per_s, rays.size()));
            single[i].push_back(msAt(results[i].single_mrays_per_s, rays.size()));
        }
        zvo_ms.push_back(zvoRays());
    }
    constexpr const char* kWhat[] = {"voxels", "triangles"};
    for (std::size_t i = 0; i < std::size(kWhat); ++i)
    {
        rows.add(subject.what(), "Embree", std::string("rays, ") + kWhat[i] + ", packets", packets[i], zvo_ms);
        rows.works.back().on_host = true;
        rows.add(subject.what(), "Embree", std::string("rays, ") + kWhat[i] + ", single", single[i], zvo_ms);
        rows.works.back().on_host = true;
    }
}
#endif

} // namespace

void compareHost(BaselineSubject& subject, BaselineRows& rows)
{
    const std::vector<std::uint64_t> codes = voxelCodes(subject.device(), subject.octree());
    baseline::HashDag dag;
    const TreeData copy = downloadTree(subject.device(), subject.octree());
    DeviceTree zvo_dag;
    subject.measure(rows,
                    {.source = "hash table",
                     .name = "DAG",
                     .baseline = [&] { return hostMs([&] { dag = baseline::hashDag(codes, subject.grid().depth); }); },
                     .zvo =
                         [&]
                     {
                         zvo_dag = {};
                         CompressResult compressed = compress(subject.device(), uploadTree(subject.device(), copy));
                         zvo_dag = std::move(compressed.dag);
                         return compressed.ms();
                     },
                     .on_host = true});
    subject.addSize(rows, "hash-table DAG", dag.node_count, dag.bytes());
    subject.addSize(rows, "zvo DAG", zvo_dag.node_count, zvo_dag.geometryBytes());

    const std::vector<PrimaryRay> rays = primaryRays(subject.camera(), kBaselineWidth, kBaselineHeight);
    const baseline::BitGrid bits(subject.grid(), codes);
    std::vector<float> times(rays.size());
    const auto traceBatch = [&](std::size_t first, std::span<const PrimaryRay> batch)
    {
        for (const PrimaryRay& ray : batch)
        {
            const auto hit = bits.firstHit(ray.origin, ray.direction, ray.t_min);
            times[first++] = hit ? hit->t : -1.0F;
        }
    };
    subject.measure(rows, {.source = "DDA",
                           .name = "rays through a bit grid",
                           .baseline = [&] { return hostMs([&] { forEachBatch(rays, traceBatch); }); },
                           .zvo = subject.rays(),
                           .on_host = true});
#ifdef ZVO_EMBREE
    compareEmbree(subject, codes, rays, rows);
#endif
}

} // namespace zvo::cli
