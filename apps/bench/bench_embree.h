// SPDX-License-Identifier: MIT
// Traces the same rays by Embree (Wald et al., Embree: A Kernel Framework for Efficient CPU Ray Tracing, 2014), for
// comparison.
#pragma once

#include "core/base/grid.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo::cli
{

/// A ray in the space where the octree's root cube is [1, 2)^3.
struct PrimaryRay
{
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F};
    float t_min = 0.0F;
};

/// The rays of a picture, block by block; the 16 rays of a block of 4 x 4 pixels are neighbours.
std::vector<PrimaryRay> primaryRays(const TraceCamera& camera, std::uint32_t width, std::uint32_t height);

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
