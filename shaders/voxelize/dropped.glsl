// SPDX-License-Identifier: MIT
// Counts triangles that are left out.
// Needs params.counters with a count for each reason.
#ifndef ZVO_SHADERS_VOXELIZE_DROPPED_GLSL
#define ZVO_SHADERS_VOXELIZE_DROPPED_GLSL

#include "voxelize/snap.glsl"

void countDropped(uint fate)
{
    if (fate == kNonfinite)
        atomicAdd(params.counters.data[0].nonfinite, 1u);
    if (fate == kOutOfRange)
        atomicAdd(params.counters.data[0].out_of_range, 1u);
    if (fate == kOutside)
        atomicAdd(params.counters.data[0].outside, 1u);
    if (fate == kZeroArea)
        atomicAdd(params.counters.data[0].zero_area, 1u);
}

#endif
