// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/radiance/device_radiance_cache.h"
#include "radiance/cached_faces.h"

namespace zvo
{

/// What shaders of a host need to know of the light that the last update() has recorded (docs/host-glsl.md). Out of
/// date with the next one, which may move all faces. Declares no access: as treeTable().
gpu::RadianceCacheTable radianceCacheTable(const DeviceRadianceCache& cache, const DeviceEnvironment& environment);

} // namespace zvo
