// SPDX-License-Identifier: MIT
// Rays and hits in device memory.
//
// Rays live in unit space: the cube that the octree's root node covers (Grid::rootResolution() voxels per edge) is
// [1, 2)^3 there, so that every plane between voxels is an exact float and a cell's coordinates are mantissa bits.
#ifndef ZVO_SHADERS_SHARED_TRACE_H
#define ZVO_SHADERS_SHARED_TRACE_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

/// A ray as the traversal takes it; the direction is only needed as its inverse.
struct Ray
{
    vec3 origin;            // unit space
    float t_min;            // hits start here; taken as kTraceTimeMin if it is less
    vec3 inverse_direction; // 1 / direction per axis, as lib/ray.glsl's inverseDirection() gives it
    float t_max;            // no hit starts after this
};
GPU_BUFFER(Ray, 8);

/// Rays of a picture's pixels in unit space. With n = (2 x + 1 - width, 2 y + 1 - height) for pixel (x, y) from the top
/// left, offset = n.x * half_pixel_x + n.y * half_pixel_y: perspective rays start at origin along forward + offset,
/// orthographic ones at origin + offset along forward. The part of forward that is orthogonal to both half pixels, the
/// camera's axis, has length 1, so t is the depth. The rest shifts the picture's middle.
struct CameraRays
{
    vec3 origin;
    vec3 forward;
    vec3 half_pixel_x; // to the right
    vec3 half_pixel_y; // down
};

/// A camera by which places are found in its picture.
struct PictureCamera
{
    CameraRays rays;
    vec3 axis; // length 1, orthogonal to the half pixels: forward, where the picture's middle is not shifted
};
GPU_BUFFER(PictureCamera, 4);

/// What a ray meets first. 16 bytes, as lib/hit.glsl packs them:
///
///     where: x 18 bits | y 18 | z 18 | level 4 | face 2, from the lowest bit of where.x on
struct Hit
{
    float t;     // where the ray enters the cell, or t_min inside of it; undefined for a miss
    uint index;  // voxel attribute index, or attribute index of the node where a level of detail stopped the ray;
                 // kHitMiss
    uvec2 where; // the cell's coordinates at its level, the level in nodes (nodeLevels() for a voxel), the face's axis
};
GPU_BUFFER(Hit, 8);

/// Counters of all passes that trace; the host clears and reads them.
struct TraceStatus
{
    uint live_tiles;  // in the list that the beam pass made
    uint capped_rays; // rays without an answer: after the last round, or the last of an occlusion's iterations
};
GPU_BUFFER(TraceStatus, 4);

const uint kHitMiss = ~0u;            // Hit::index of a ray that met nothing
const uint kHitUnfinished = ~0u - 1u; // between two rounds: t and face are the ray's last event

const uint kHitCoordinateBits = 18u;
const uint kHitLevelShift = 54u; // in Hit::where
const uint kHitFaceShift = 58u;
const uint kFaceInside = 3u; // Hit's face when the ray started inside the cell

const float kTraceTimeMin = 1.17549435e-38f; // smallest normal float: below it, devices may flush to zero
const float kTraceTimeMax = 3.40282347e+38f; // largest float

// Iterations of an invocation; lavapipe ends every loop after 65,535. Rays that need more resume in another round.
const uint kTraceIterationsMax = 40000u;
const uint kTraceRoundsMax = 16u; // of rays through one octree; depth 17 needs 14

GPU_NAMESPACE_END

#endif
