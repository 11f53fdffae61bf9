// SPDX-License-Identifier: MIT
// Distances that the device finds, and copies of them on the host. All functions wait for the device.
#pragma once

#include "core/distance/distance_builder.h"
#include "core/distance/distance_data.h"
#include "vk/headless.h"

namespace zvo
{

/// Finds the distances of a scene. Throws as DistanceBuilder.
DistanceResult findDistances(vk::HeadlessDevice& device, const PosedGpuScene& scene, const Grid& grid,
                             const DistanceOptions& options);

DistanceData downloadDistances(vk::HeadlessDevice& device, const DeviceDistances& distances);

} // namespace zvo
