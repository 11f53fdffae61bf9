// SPDX-License-Identifier: MIT
// Rays and hits in device memory.
//
// Rays live in unit space: the cube that the octree's root node covers (Grid::rootResolution() voxels per edge) is
// [1, 2)^3 there, so that every plane between voxels is an exact float and a cell's coordinates are mantissa bits.
#ifndef ZVO_SHADERS_SHARED_TRACE_H
#define ZVO_SHADERS_SHARED_TRACE_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

/// A ray as the traversal takes it: the direction only through its inverse. 32 bytes.
struct Ray
{
    vec3 origin;            // unit space
    float t_min;            // hits start here; at least the smallest normal float
    vec3 inverse_direction; // 1 / direction per axis, no component zero; see lib/ray.glsl
    float t_max;            // no hit starts after this; may be infinite
};
GPU_BUFFER(Ray, 4);

/// What a ray met first. 20 bytes.
struct Hit
{
    float t;     // where the ray enters the cell, or t_min inside of it; undefined for a miss
    uint index;  // voxel attribute index, or node where a level of detail stopped the ray; kHitMiss
    uint info;   // iterations | face << 16 | level << 19, see lib/hit.glsl
    uvec2 cell;  // cell coordinates at that level: x | y << 18 | z << 36 in 64 bits
};
GPU_BUFFER(Hit, 4);

const uint kHitMiss = ~0u; // Hit::index of a ray that met nothing

const uint kHitFaceShift = 16u;  // Hit::info: the axis of the face that was hit, or kFaceInside
const uint kHitLevelShift = 19u; // Hit::info: node levels above the cell; nodeLevels() for a voxel
const uint kHitFaceMask = 7u;
const uint kHitLevelMask = 15u;
const uint kHitIterationsMask = (1u << kHitFaceShift) - 1u;
const uint kFaceInside = 3u; // the ray started inside the cell

const uint kTraceStepsMax = 40000u; // iterations of one ray; running into it is counted in TraceStatus

GPU_NAMESPACE_END

#endif
