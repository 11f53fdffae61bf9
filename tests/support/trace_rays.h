// SPDX-License-Identifier: MIT
// Lists of rays on the device, and their comparison with the reference.
#pragma once

#include "core/trace/trace.h"
#include "oracle/trace.h"
#include "support/trace_octrees.h"
#include "vk/headless.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace zvo::test
{

/// A hit of the device, unpacked.
struct DeviceHit
{
    float t = 0.0F;
    std::uint32_t index = 0;
    std::uint32_t face = 0;
    std::uint32_t level = 0;
    glm::uvec3 cell{0U};
};

/// Returns nothing for a miss.
std::optional<DeviceHit> unpack(const gpu::Hit& hit);

gpu::Ray deviceRay(const oracle::Ray& ray, float t_max = std::numeric_limits<float>::infinity());

/// Rays from inside, outside and far away; some along axes and diagonals, some from and through corners of voxels, some
/// almost parallel to planes. resolution: of the root cube. very_far: some rays begin a million cubes away. There
/// planes coincide by rounding, and the reference has to look at almost every voxel.
oracle::Ray pickRay(std::mt19937& random, std::uint32_t resolution, const Codes& codes, bool very_far = true);

/// count of these rays for the device.
std::vector<gpu::Ray> pickRays(std::mt19937& random, std::uint32_t resolution, const Codes& codes, std::uint32_t count);

/// The hits of rays in the same order, and the number of rays without an answer.
struct TracedRays
{
    std::vector<gpu::Hit> hits;
    std::uint32_t capped_rays = 0;
};
TracedRays traceRaysOf(vk::HeadlessDevice& device, const DeviceTree& tree, const std::vector<gpu::Ray>& rays,
                       const TraceOptions& options = {});

/// Traces rays and returns their hits in the same order. Expects that capped_count rays got no answer.
std::vector<gpu::Hit> traceOnDevice(vk::HeadlessDevice& device, const DeviceTree& tree,
                                    const std::vector<gpu::Ray>& rays, const TraceOptions& options = {},
                                    std::uint32_t capped_count = 0);

/// Traces count rays of many kinds through tree, whose voxels are codes. Expects that voxel, t and face of each hit
/// equal the reference bit for bit, and that some rays hit.
void expectEqualsReference(vk::HeadlessDevice& device, const DeviceTree& tree, const Codes& codes, std::uint32_t count,
                           const TraceOptions& options = {}, bool very_far = true);

} // namespace zvo::test
