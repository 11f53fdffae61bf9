// SPDX-License-Identifier: MIT
// Primary rays through octrees and DAGs.
#pragma once

#include "bench/bench_table.h"
#include "core/trace/tree_tracer.h"
#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo::cli
{

constexpr std::uint32_t kTraceTurns = 3; // pictures for each run, as they take less time than the rest

/// Traces pictures of one tree. Device, tree and tracer must outlive this object.
class PrimaryRays
{
public:
    /// Makes the tree's node paths and traces a picture as a warm-up.
    PrimaryRays(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera, TreeTracer& tracer);

    /// Traces a picture and returns its passes: beam and primary rays. Node paths are made first if it is another
    /// tree's.
    std::vector<vk::PassTime> trace();

    [[nodiscard]] double nodePathsMs() const { return m_node_paths_ms; }

private:
    double prepare();

    vk::HeadlessDevice& m_device;
    const DeviceTree& m_tree;
    const TraceCamera& m_camera;
    TreeTracer& m_tracer;
    double m_node_paths_ms = 0;
};

/// Times of pictures of an octree and of its DAG.
struct TraceRuns
{
    Spread octree_ms;
    Spread dag_ms;
    Spread ratio;                            // DAG / octree, of pictures that were traced in turns
    std::vector<vk::PassTime> octree_passes; // mean of the runs, summed by name
    std::vector<vk::PassTime> dag_passes;
};

/// Traces both in turns, changing the order each time, so that other load of the machine affects both equally.
TraceRuns traceInTurns(PrimaryRays& octree, PrimaryRays& dag, std::uint32_t turn_count);

/// Measures the octree alone if there is no DAG; the rest of the result is empty.
TraceRuns traceAlone(PrimaryRays& octree, std::uint32_t turn_count);

/// Number of pixels of the last picture whose ray hit something.
std::uint64_t countHits(vk::HeadlessDevice& device, const TraceBuffers& buffers);

} // namespace zvo::cli
