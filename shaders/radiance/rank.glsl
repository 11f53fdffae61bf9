// SPDX-License-Identifier: MIT
// The ranks of faces (radiance/radiance.h).
#ifndef ZVO_SHADERS_RADIANCE_RANK_GLSL
#define ZVO_SHADERS_RADIANCE_RANK_GLSL

#include "lib/sampling.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/radiance.h"

const float kSeenShare = 8.0;   // a face that the camera sees is taken so much more often than others
const float kFreshShare = 64.0; // one without samples, than one with as many or more

// The rank of a face in a frame: it does not depend on the slot.
uint rankOfFace(CachedFace face, uint mark, uint frame)
{
    uvec2 seeds = seedsOfFace(face.key);
    uint random = hashPair(hashPair(seeds.x, seeds.y), frame) >> 9;
    float share = max(kFreshShare / float(cachedWeight(face.light) + 1u), 1.0) *
                  ((mark & kFaceSeen) != 0u ? kSeenShare : 1.0);
    precise float place = (float(random) + 0.5) / (8388608.0 * share);
    return clamp(floatBitsToUint(place) >> kRankShift, kRankFirst, kRankFirst + kFaceRanks - 1u) - kRankFirst;
}

#endif
