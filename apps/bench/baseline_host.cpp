// SPDX-License-Identifier: MIT
#include "baseline/bit_grid.h"
#include "baseline/hash_dag.h"
#include "bench/baseline_comparisons.h"
#include "bench/bench_embree.h"
#include "bench/primary_rays.h"
#include "core/tree/tree_data.h"
#include "runtime/trees.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
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
void compareEmbree(BaselineSubject& subject, const EmbreeScene& scene, const std::string& what,
                   std::span<const PrimaryRay> rays, BaselineRows& rows)
{
    const unsigned packet = scene.fasterWidth(rays);
    for (const unsigned width : {packet, 1U})
    {
        subject.measure(rows, {.source = "Embree",
                               .name = "rays, " + what + (width == 1 ? ", single" : ", packets"),
                               .baseline = [&, width] { return 1e3 * scene.trace(rays, width).seconds; },
                               .zvo = subject.rays(),
                               .on_host = true});
    }
}
#endif

} // namespace

void compareHost(BaselineSubject& subject, BaselineRows& rows)
{
    const std::vector<std::uint64_t> codes = voxelCodes(subject.device(), subject.octree());
    baseline::HashDag dag;
    const TreeData copy = geometryOf(subject);
    DeviceTree zvo_dag;
    // From voxels that are known to the DAG: for zvo, its construction of the octree and its compression.
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
                         return compressed.ms() + subject.geometryBuildMs();
                     },
                     .on_host = true});
    subject.addSize(rows, "hash-table DAG", dag.node_count, dag.bytes());
    subject.addSize(rows, "zvo DAG", zvo_dag.node_count, zvo_dag.geometryBytes());

    const std::vector<PrimaryRay> rays = primaryRays(subject.camera(), kBaselineWidth, kBaselineHeight);
    if (subject.grid().depth <= baseline::BitGrid::kDepthMax)
    {
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
    }
#ifdef ZVO_EMBREE
    compareEmbree(subject, EmbreeScene::ofVoxels(subject.grid(), codes), "voxels", rays, rows);
    compareEmbree(subject, EmbreeScene::ofTriangles(subject.grid(), subject.scene()), "triangles", rays, rows);
#endif
}

} // namespace zvo::cli
