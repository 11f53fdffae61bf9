// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "query/query.h"
#include "vk/frame_graph.h"
#include "vk/uploader.h"
#include "zvo/query.h"

#include <cstdint>
#include <span>

namespace zvo
{

static_assert(kLatticeVoxel == gpu::kVoxelLattice && kQueryInside == gpu::kFaceInside);
static_assert(static_cast<gpu::uint>(QueryKind::Sweep) == gpu::kQuerySweep);

/// The kind of a list.
inline QueryKind kindOf(const QueryList& queries)
{
    return static_cast<QueryKind>(queries.index());
}

/// Number of questions of a list.
std::size_t sizeOf(const QueryList& queries);

/// A list of questions of one kind on the device, and what it finds.
struct QueryBuffers
{
    /// Uploads queries, at least one, which are asked of trees in that grid. Throws Error{Memory}.
    QueryBuffers(vk::Uploader& uploader, const QueryList& queries, const Grid& grid);

    QueryKind kind;
    std::uint32_t count;
    vk::BufferOf<gpu::uint> numbers;        // [count * numbers of one]; empty for rays
    vk::BufferOf<gpu::Ray> rays;            // [count], or empty
    vk::BufferOf<gpu::Hit> hits;            // [count]
    vk::BufferOf<gpu::QueryLook> looks;     // [count]
    vk::BufferOf<gpu::DispatchArgs> rounds; // [kTraceRoundsMax], for rays
    vk::BufferOf<gpu::TraceStatus> status;  // [1] capped_rays: undecided questions, since it was cleared
};

/// Records the passes that fill buffers.hits, buffers.looks where tree has attributes, and buffers.status. In a DAG
/// without attributes, Hit::index only tells what was found. Hit::t is rounded as the device likes, but for rays.
/// iterations_max: of an invocation; fewer only for tests. Cost: of each question, its iterations; for attributes in a
/// DAG, levels of nodes for each voxel that was found.
void answerQueries(vk::FrameGraph& graph, const DeviceTree& tree, QueryBuffers& buffers,
                   std::uint32_t iterations_max = gpu::kTraceIterationsMax);

/// What questions were asked of.
struct QueriedTree
{
    explicit QueriedTree(const DeviceTree& tree)
        : grid(tree.grid), has_attributes(tree.hasAttributes()), emission_scale(tree.emission_scale)
    {
    }

    Grid grid;
    bool has_attributes;
    float emission_scale;
};

/// The answers to the questions from `first` on, of what the device has found for them. hits, looks, answers: one for
/// each. The numbers that do not come from the voxel are computed here, from the questions.
void readAnswers(const QueriedTree& tree, const QueryList& queries, std::size_t first, std::span<const gpu::Hit> hits,
                 std::span<const gpu::QueryLook> looks, std::span<QueryAnswer> answers);

/// As the public function, of an engine's grid.
LatticePosition latticePosition(const Grid& grid, const glm::dvec3& world);

} // namespace zvo
