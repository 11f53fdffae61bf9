#version 460
// SPDX-License-Identifier: MIT
// Adds a sample to the means of each face that the frame takes. Later samples weigh more, the n-th as much as its
// number: the light that faces reflect to each other is still dim in the first ones.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"
#include "lib/dispatch.glsl"
#include "lib/sobol.glsl"

layout(local_size_x = kRadianceGroup) in;
layout(push_constant, scalar) uniform Push
{
    RadianceApplyParams params;
};

#include "path/lists.glsl"
#include "radiance/kept_light.glsl"

// A mean with one more sample, which weighs as much as 2 / (count + 1).
vec3 towards(vec3 mean, vec3 sampled, uint count)
{
    precise vec3 moved = mean + (sampled - mean) * (2.0 / float(count + 1u));
    return max(moved, vec3(0.0));
}

void main()
{
    uint i = threadIndex();
    if (i >= listLength(0u, kListPaths))
        return;
    uint number = params.numbers.data[i];
    uint slot = number & ~kPathMoved;
    FaceState state = params.states.data[slot];
    uint now = params.frame % kMarkFrames + 1u;
    uint moved_frame = (number & kPathMoved) != 0u ? now : (state.mark >> kMarkMovedShift) & kMarkFrames;
    bool moved = moved_frame != 0u && (now + kMarkFrames - moved_frame) % kMarkFrames < kMovedFrames;
    moved_frame = moved ? moved_frame : 0u;
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(params.faces));
    uvec2 key = unpackUint2x32(words.data[2u * slot]);
    uvec2 light = unpackUint2x32(words.data[2u * slot + 1u]);
    vec3 sampled = params.radiance.data[i];
    uint count = keptWeight(light) + 1u;
    uint random = hashPair(hashPair(key.y, key.x), params.frame);
    vec3 thresholds = vec3(random & 1023u, bitfieldExtract(random, 10, 10), bitfieldExtract(random, 20, 10)) / 1024.0;

    count = moved ? min(count, kMovedSamples) : count;
    uint weight = min(count, params.window);
    words.data[2u * slot + 1u] =
        packUint2x32(packKept(towards(keptRadiance(light), sampled, weight), weight, thresholds));
    vec3 recent = towards(recentRadiance(state.recent), sampled, min(count, kRecentSamples));
    uint mark = (state.mark & ~(kMarkFrames << kMarkMovedShift)) | (moved_frame << kMarkMovedShift);
    params.states.data[slot] = FaceState(mark, packRecent(recent, thresholds));
}
