// SPDX-License-Identifier: MIT
// Traces the same rays by Embree (Wald et al., Embree: A Kernel Framework for Efficient CPU Ray Tracing, 2014), for
// comparison.
#pragma once

#include "bench/primary_rays.h"
#include "core/base/grid.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <span>

namespace zvo::cli
{

struct EmbreeResult
{
    double mrays_per_s = 0;        // median of the runs, in packets of 8 or of 16 rays, whichever is faster
    double single_mrays_per_s = 0; // ray by ray, one run
    std::uint64_t hit_count = 0;   // rays that hit something
};

/// Traces rays through voxels on all processors, run_count times after a warm-up. Each voxel is a user primitive with
/// an exact slab test. Neighbours in the list should be neighbours in the picture. codes: Morton codes of the voxels.
/// Throws Error{Memory}.
EmbreeResult traceVoxelsByEmbree(const Grid& grid, std::span<const std::uint64_t> codes,
                                 std::span<const PrimaryRay> rays, std::uint32_t run_count);

/// Traces the same rays through the scene's triangles, which are all opaque; each instance has its own copy of them.
EmbreeResult traceTrianglesByEmbree(const Grid& grid, const Scene& scene, std::span<const PrimaryRay> rays,
                                    std::uint32_t run_count);

} // namespace zvo::cli
