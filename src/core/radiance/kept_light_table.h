// SPDX-License-Identifier: MIT
#pragma once

#include "core/light/environment.h"
#include "core/radiance/radiance_cache.h"
#include "radiance/kept_faces.h"

namespace zvo
{

/// What shaders of a host need to know of the light that the last update() has recorded (docs/host-glsl.md). Out of
/// date with the next one, which may move all faces. Declares no access: as treeTable().
gpu::KeptLightTable keptLightTable(const RadianceCache& cache, const DeviceEnvironment& environment);

} // namespace zvo
