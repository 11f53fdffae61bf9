// SPDX-License-Identifier: MIT
// Rays as pictures and paths trace them from where other rays have hit, made on the host, the same in every run.
#pragma once

#include "bench/primary_rays.h"
#include "core/base/grid.h"
#include "core/trace/trace.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace zvo::cli
{

/// Where a ray has entered a voxel.
struct FacePoint
{
    glm::vec3 position{0.0F}; // on the face exactly, and inside of its edges
    int axis = 0;             // of the face
    float side = 1.0F;        // of the voxel along the axis: 1 or -1
};

/// A ray as kernels take it.
gpu::Ray deviceRay(const PrimaryRay& ray);

/// Where rays have hit voxels from outside, in the order of the rays.
std::vector<FacePoint> facePoints(std::span<const PrimaryRay> rays, std::span<const gpu::Hit> hits);

/// A ray from each face that the direction does not come out of the back of.
std::vector<PrimaryRay> raysToward(const Grid& grid, std::span<const FacePoint> points, const glm::vec3& direction);

/// A ray from each face, in a random direction by its cosine with the normal. reach: the rays' length.
std::vector<PrimaryRay> scatteredRays(const Grid& grid, std::span<const FacePoint> points, float reach,
                                      std::uint32_t seed);

/// count rays from random points of a box in random directions, both spread evenly.
std::vector<PrimaryRay> raysWithin(const glm::vec3& low, const glm::vec3& high, std::size_t count, std::uint32_t seed);

} // namespace zvo::cli
