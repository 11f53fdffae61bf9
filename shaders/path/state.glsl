// SPDX-License-Identifier: MIT
// The state of a path (path/path.h): the random numbers that it takes, and its loads and stores as 64-bit words, as
// those of rays; and where its shadow rays end.
#ifndef ZVO_SHADERS_PATH_STATE_GLSL
#define ZVO_SHADERS_PATH_STATE_GLSL

#include "lib/hit.glsl"
#include "path/path.h"

// Pairs of random numbers of a path (lib/sampling.glsl): the camera takes the first two, each bounce kPathPairs.
const uint kPairPixel = 0u;
const uint kPairLens = 1u;
const uint kPairDirection = 2u; // of the next ray
const uint kPairChoice = 3u;    // of a light
const uint kPairPoint = 4u;     // of the light
const uint kPairOther = 5u;     // kind of light, roulette
const uint kPathPairs = 4u;     // of a bounce

// The state of a path that begins.
PathState stateOfCamera(uint slot, uint seed)
{
    return PathState(vec3(1.0), slot, seed, 0u, 0.0, vec3(0.0));
}

PathState loadState(PathState_ConstPtr states, uint i)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(states));
    uvec2 a = unpackUint2x32(words.data[5u * i]);
    uvec2 b = unpackUint2x32(words.data[5u * i + 1u]);
    uvec2 c = unpackUint2x32(words.data[5u * i + 2u]);
    uvec2 d = unpackUint2x32(words.data[5u * i + 3u]);
    uvec2 e = unpackUint2x32(words.data[5u * i + 4u]);
    return PathState(uintBitsToFloat(uvec3(a, b.x)), b.y, c.x, c.y, uintBitsToFloat(d.x), uintBitsToFloat(uvec3(d.y, e)));
}

void storeState(PathState_Ptr states, uint i, PathState state)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(states));
    words.data[5u * i] = packUint2x32(floatBitsToUint(state.throughput.xy));
    words.data[5u * i + 1u] = packUint2x32(uvec2(floatBitsToUint(state.throughput.z), state.slot));
    words.data[5u * i + 2u] = packUint2x32(uvec2(state.seed, state.normal));
    words.data[5u * i + 3u] = packUint2x32(floatBitsToUint(vec2(state.density, state.kinds.x)));
    words.data[5u * i + 4u] = packUint2x32(floatBitsToUint(state.kinds.yz));
}

// Whether nothing is in the way of a shadow ray that has met this. target: as in ShadowState.
bool reachesLight(Hit hit, uvec2 target)
{
    return target == uvec2(kNoTarget) ? isMiss(hit) : !isMiss(hit) && hit.where == target;
}

#endif
