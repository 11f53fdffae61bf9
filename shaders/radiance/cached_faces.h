// SPDX-License-Identifier: MIT
// What shaders need to know to find the cached light of a face (radiance/radiance.h). Those of hosts get it by
// its address (host/radiance_cache.glsl).
#ifndef ZVO_SHADERS_RADIANCE_CACHED_FACES_H
#define ZVO_SHADERS_RADIANCE_CACHED_FACES_H

#include "light/outside.h"

GPU_NAMESPACE_BEGIN

/// A face, or the faces of a brick, with the light that is shown.
///
///     key    x 18 bits | y 9 of 18 | kFaceKeyTag | of the faces whose first slot this is: how far others may be, 4
///            y 9 of 18 | z 18 | number of the normal, plus 1, 3 (LightBrick::exposed) | level 2 (0: a face)
///     light  red 16 | green 16
///            blue 16 | exponent 6 | samples 10, of the face or the brick alone (radiance/cached_face.glsl)
///
/// A first word of 0 means that the slot is free; the words of the key are set one after the other (lib/bricks.glsl).
struct CachedFace
{
    uvec2 key;
    uvec2 light;
};
GPU_BUFFER(CachedFace, 16);

const uint kCachedFaceBytes = 16u;
const uint kFaceKeyTag = 1u << 27; // in the first word of a key
const uint kFaceReachShift = 28u;  // of its last bits (radiance/face_table.glsl)
const uint kFaceRun = 8u;          // slots that faces of 2x2x2 cells with the same normal share as their first ones
const uint kBrickLevels = 3u;      // of bricks: of 4^3, 16^3 and 64^3 voxels
const uint kFaceProbesMax = 128u;  // slots looked at before the table counts as full
const uint kFaceRunsMin = 16u;     // of a table: steps are less than their slots

/// Where the radiance cache is in device memory, with the light from outside of the grid.
struct RadianceCacheTable
{
    GPU_CONST_PTR(CachedFace) faces;        // [kFaceRun * run_count]; 0: none are kept
    GPU_CONST_PTR(Environment) environment; // 0 where faces is
    uint run_count;
    uint frame_count; // since all light was forgotten
};
GPU_BUFFER(RadianceCacheTable, 8);

GPU_NAMESPACE_END

#endif
