// SPDX-License-Identifier: MIT
// The primary rays of a picture on the host, for programs that trace them there.
#pragma once

#include "core/scene/camera.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
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
    float t_max = std::numeric_limits<float>::infinity();
};

/// The rays of a picture, block by block; the 16 rays of a block of 4 x 4 pixels are neighbours.
std::vector<PrimaryRay> primaryRays(const TraceCamera& camera, std::uint32_t width, std::uint32_t height);

/// Calls work for batches of rays on all processors, each with the number of its first ray.
void forEachBatch(std::span<const PrimaryRay> rays,
                  const std::function<void(std::size_t first, std::span<const PrimaryRay> batch)>& work);

} // namespace zvo::cli
