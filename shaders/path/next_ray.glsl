// SPDX-License-Identifier: MIT
// How a path goes on from a hit. The includer includes path/path.h, lib/hit.glsl, path/hit_voxel.glsl and
// path/leave.glsl before and declares kRoulette and params.
#ifndef ZVO_SHADERS_PATH_NEXT_RAY_GLSL
#define ZVO_SHADERS_PATH_NEXT_RAY_GLSL

#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "lib/sampling.glsl"
#include "path/hit_voxel.glsl"
#include "path/leave.glsl"
#include "path/numbers.glsl"
#include "path/path.h"

const float kRouletteMax = 0.95; // probability to go on
const uint kRouletteFirst = 3u;  // bounce

// The ray by which a path goes on from a hit, if it does.
NextRay nextRay(PathState state, Ray ray, bool hits, Hit hit, Attribute stored, uint bounce)
{
    state.throughput *= albedoOf(stored);
    float strongest = max(state.throughput.r, max(state.throughput.g, state.throughput.b));
    NextRay next;
    next.exists = hits && hitFace(hit) != kFaceInside && strongest > 0.0;
    vec2 other = samplePair(params.sample_index, state.seed, bounce * kPathPairs + kPairOther);
    next.choice = other.x;
    if (kRoulette && bounce >= kRouletteFirst)
    {
        float survives = min(strongest, kRouletteMax);
        next.exists = next.exists && other.y < survives;
        state.throughput /= max(survives, 1e-20);
    }

    state.normal = normalOfHit(min(hitFace(hit), 2u), ray.inverse_direction);
    next.state = state;
    vec3 point = ray.origin + hit.t / ray.inverse_direction;
    leaveFace(pointOnFace(point, hitCell(hit), normalAxis(state.normal)), bounce, next);
    return next;
}

#endif
