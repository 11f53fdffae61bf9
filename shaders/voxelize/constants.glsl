// SPDX-License-Identifier: MIT
// What follows from the constants of the raster kernels. Needs GPU_ENTRY with RasterParams.
#ifndef ZVO_SHADERS_VOXELIZE_CONSTANTS_GLSL
#define ZVO_SHADERS_VOXELIZE_CONSTANTS_GLSL

#include "voxelize/voxelize.h"

const bool kThin = kCoverage == kCoverageThin;
const uint kGroupBands = kBandsGroup / kStripLanes; // bands that a workgroup of voxelize/bands takes

// Workgroups of voxelize/bands.
uint bandGroups(uint band_count)
{
    return (band_count + kGroupBands - 1u) / kGroupBands;
}

#endif
