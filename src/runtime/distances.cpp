// SPDX-License-Identifier: MIT
#include "runtime/distances.h"

#include "runtime/run_job.h"

namespace zvo
{

DistanceResult findDistances(vk::HeadlessDevice& device, const PosedGpuScene& scene, const Grid& grid,
                             const DistanceOptions& options)
{
    return runJob(device, DistanceBuilder(device.device(), scene, grid, options));
}

DistanceData downloadDistances(vk::HeadlessDevice& device, const DeviceDistances& distances)
{
    return {distances.grid, distances.band, device.download(distances.leaves), device.download(distances.squared)};
}

} // namespace zvo
