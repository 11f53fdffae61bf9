// SPDX-License-Identifier: MIT
// Specialization constants of the raster kernels.
#ifndef ZVO_SHADERS_VOXELIZE_CONSTANTS_GLSL
#define ZVO_SHADERS_VOXELIZE_CONSTANTS_GLSL

#include "voxelize/voxelize.h"

layout(constant_id = 0) const uint kCoverage = 0u;
layout(constant_id = 1) const uint kMode = 0u;
layout(constant_id = 2) const uint kMaterialClass = 0u;
layout(constant_id = 3) const bool kEmits = false;
layout(constant_id = 4) const uint kBlockColumns = 256u; // columns of a row block: bounds the work of a thread
layout(constant_id = 5) const uint kStripLanes = 1u;     // threads of voxelize/bands that share a band

const bool kThin = kCoverage == kCoverageThin;
const uint kGroupBands = kBandsGroup / kStripLanes; // bands that a workgroup of voxelize/bands takes

layout(push_constant, scalar) uniform Push
{
    RasterParams params;
};

// Workgroups of voxelize/bands.
uint bandGroups(uint band_count)
{
    return (band_count + kGroupBands - 1u) / kGroupBands;
}

#endif
