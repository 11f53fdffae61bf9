// SPDX-License-Identifier: MIT
// Embree (Wald et al., Embree: A Kernel Framework for Efficient CPU Ray Tracing, 2014) on the same rays, to compare
// with.
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

/// A primary ray in the space in which the octree's root cube is [1, 2)^3.
struct PrimaryRay
{
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F};
};

/// The rays of a picture, 16 neighbours in each block of 4 x 4 pixels one after another.
std::vector<PrimaryRay> primaryRays(const TraceCamera& camera, std::uint32_t width, std::uint32_t height);

struct EmbreeResult
{
    double mrays_per_s = 0;        // median of the runs, in packets of 8 or of 16 rays, whichever is faster
    double single_mrays_per_s = 0; // ray by ray, one run
    std::uint64_t hit_count = 0;   // rays that hit something
};

/// Traces rays, neighbours in the picture beside each other, on all processors through voxels, each a user primitive
/// with an exact slab test, run_count times after a warm-up. codes: their Morton codes. Throws Error{Memory}.
EmbreeResult traceVoxelsByEmbree(const Grid& grid, std::span<const std::uint64_t> codes,
                                 std::span<const PrimaryRay> rays, std::uint32_t run_count);

/// The same through the scene's triangles, all opaque and instances unrolled.
EmbreeResult traceTrianglesByEmbree(const Grid& grid, const Scene& scene, std::span<const PrimaryRay> rays,
                                    std::uint32_t run_count);

} // namespace zvo::cli
