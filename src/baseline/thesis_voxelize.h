// SPDX-License-Identifier: MIT
// The voxelization of the thesis: Y. Pan, Dynamic Update of Sparse Voxel Octree Based on Morton Code, Purdue
// University, 2021.
#pragma once

#include "baseline/thesis.h"
#include "core/base/grid.h"
#include "core/deform/dynamic_object.h"
#include "core/upload/gpu_scene.h"
#include "vk/frame_graph.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace zvo::baseline
{

/// What becomes of a covered voxel.
enum class ThesisTarget : std::uint32_t
{
    Occupancy = gpu::kThesisOccupancy, ///< its cell is marked, black
    Colors = gpu::kThesisColors, ///< its cell gets the last fragment's colour and normal, as in the thesis: they depend
                                 ///< on the order of threads
    Sums = gpu::kThesisSums,     ///< its cell gets the mean of its fragments, as in zvo, up to 65,535 of them
    Fragments = gpu::kThesisFragments, ///< the fragment is appended to a list
};

/// The Morton codes between which voxels lie, both included; none if first > last.
struct CodeRange
{
    std::uint32_t first = 0;
    std::uint32_t last = 0;

    bool operator==(const CodeRange&) const = default;
};

/// The triangles of a scene, set up for one grid.
struct ThesisTriangles
{
    struct Range
    {
        std::uint64_t first = 0;
        std::uint64_t count = 0;
    };

    /// 100 bytes a triangle of scene, where draws count as multiples of 64 triangles.
    ThesisTriangles(vk::Device& device, const GpuScene& scene);

    std::array<Range, gpu::kClassCount> ranges;  // of each MaterialClass
    vk::BufferOf<gpu::ThesisTriangle> triangles; // those without voxels among them
    vk::BufferOf<gpu::uint> big;                 // [triangles] numbers of those whose boxes have more than one part
    vk::BufferOf<gpu::ThesisCounters> counters;  // [1]
    std::uint32_t part_count = 0;                // of the largest box, learned after the setup, like the next one
    std::uint32_t big_count = 0;
    std::uint32_t cells_per_part; // that a thread tests

    /// What suits the device: whole boxes on GPUs, as in the thesis, which may take longer there than a desktop allows;
    /// parts of them where the loops of a thread end after 65,535 iterations.
    static std::uint32_t cellsPerPartOn(const vk::Device& device);
};

/// The dense buffers of a voxelization, in Morton order.
struct ThesisCells
{
    /// Takes 8 bytes a cell of the grid, 40 with sums. Throws Error{Usage} for a depth beyond gpu::kThesisDepthMax,
    /// Error{Memory} when the device's budget does not suffice.
    ThesisCells(vk::Device& device, const Grid& cells_grid, bool with_sums = false);

    Grid grid;
    vk::BufferOf<gpu::Attribute> voxels; // [8^depth] alpha 255 where occupied, else 0
    vk::BufferOf<gpu::VoxelSums> sums;   // [8^depth], or empty
};

/// A scene, and how it is voxelized.
struct ThesisJob
{
    PosedGpuScene scene;
    Grid grid;
    Coverage coverage = Coverage::Conservative;
    ThesisTriangles& triangles;
    bool bounds = false; // find the smallest and the largest code that occurs: future work in the thesis. Not for lists
};

/// Records the pass that sets up every triangle of job.scene (baseline/thesis_setup), and what clears the counters.
/// Cost: triangles.
void setUpTriangles(vk::FrameGraph& graph, const ThesisJob& job);

/// Records the passes in which a thread a triangle tests each voxel of the triangle's bounding box
/// (baseline/thesis_voxelize): one for each material class that occurs and, where boxes have several parts, more for
/// these; before that, what clears cells. job.triangles must have the counts of the last setup, as voxelizeThesis()
/// leaves them. The voxels are zvo's, bit for bit: the test is exact, in 64-bit integers, where the thesis takes
/// floating point. Alpha decides as in zvo; emission is left out. target: not Fragments; Sums takes cells with sums,
/// and ends with baseline/thesis_resolve. Cost: the volume of all bounding boxes, and 8^depth.
void walkTriangles(vk::FrameGraph& graph, const ThesisJob& job, ThesisTarget target, ThesisCells& cells);

/// Records the same walk with ThesisTarget::Fragments, in any order. What has no room in fragments is only counted.
void appendFragments(vk::FrameGraph& graph, const ThesisJob& job, vk::BufferOf<gpu::VoxelFragment>& fragments);

/// Sets up and walks, and waits after each. Returns the times of the passes. Textures of a scene that was uploaded
/// without attributes do not count, but for alpha. range: becomes what was found, or all codes without job.bounds.
std::vector<vk::PassTime> voxelizeThesis(vk::HeadlessDevice& device, const ThesisJob& job, ThesisTarget target,
                                         ThesisCells& cells, CodeRange* range = nullptr);

/// A list of fragments, and how it came about.
struct FragmentList
{
    vk::BufferOf<gpu::VoxelFragment> fragments; // [count]
    std::vector<vk::PassTime> passes;           // the walk that counts, then the one that appends
};

/// Sets up, walks to count, and walks to append, and waits after each. Throws Error{Usage} for a depth beyond
/// gpu::kPointerDepthMax, Error{Memory}.
FragmentList listFragments(vk::HeadlessDevice& device, const ThesisJob& job);

} // namespace zvo::baseline
