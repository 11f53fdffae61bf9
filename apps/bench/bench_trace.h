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

/// Traces pictures of one tree. What is given must outlive this.
class PrimaryRays
{
public:
    /// Makes the tree's beam grid and traces a picture, so that the next ones are warm.
    PrimaryRays(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera, TreeTracer& tracer);

    /// The passes of a picture: beam and primary rays, once the beam grid is this tree's.
    std::vector<vk::PassTime> trace();

    [[nodiscard]] double beamGridMs() const { return m_beam_grid_ms; }

private:
    double prepare();

    vk::HeadlessDevice& m_device;
    const DeviceTree& m_tree;
    const TraceCamera& m_camera;
    TreeTracer& m_tracer;
    double m_beam_grid_ms = 0;
};

/// Times of pictures of an octree and of its DAG.
struct TraceRuns
{
    Spread octree_ms;
    Spread dag_ms;
    Spread ratio;                            // DAG / octree, of pictures that were traced one after the other
    std::vector<vk::PassTime> octree_passes; // mean of the runs, summed by name
    std::vector<vk::PassTime> dag_passes;
};

/// Traces both, turn by turn, each turn the other one first: what else the machine does meets both alike.
TraceRuns traceInTurns(PrimaryRays& octree, PrimaryRays& dag, std::uint32_t turn_count);

/// The octree's alone, where there is no DAG: the rest of the result is empty.
TraceRuns traceAlone(PrimaryRays& octree, std::uint32_t turn_count);

/// Pixels of the last picture whose ray hit something.
std::uint64_t countHits(vk::HeadlessDevice& device, const TraceBuffers& buffers);

} // namespace zvo::cli
