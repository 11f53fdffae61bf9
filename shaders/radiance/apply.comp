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

// The mark of a face whose path has hit what its number tells.
uint markAfter(uint mark, uint number)
{
    uint now = params.frame % kMarkMovedFrames + 1u;
    uint last = (mark >> kMarkMovedShift) & kMarkMovedFrames;
    uint age = last == 0u ? kMovedFrames : (now + kMarkMovedFrames - last) % kMarkMovedFrames;
    bool to_light = (number & kPathMoved) != 0u;
    bool touches = to_light || (number & kPathTouched) != 0u;
    bool matters = (mark & kFaceMoved) != 0u && age < (touches ? kMovedRare : kMovedFrames);
    matters = matters || to_light || (touches && age <= kMovedAgain);
    last = touches ? now : age < kMovedFrames ? last : 0u;
    mark &= ~((kMarkMovedFrames << kMarkMovedShift) | kFaceMoved);
    return mark | (last << kMarkMovedShift) | (matters ? kFaceMoved : 0u);
}

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
    uint slot = number & ~(kPathMoved | kPathTouched);
    FaceState state = params.states.data[slot];
    uint mark = markAfter(state.mark, number);
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(params.faces));
    uvec2 key = unpackUint2x32(words.data[2u * slot]);
    uvec2 light = unpackUint2x32(words.data[2u * slot + 1u]);
    vec3 sampled = params.radiance.data[i];
    uint count = keptWeight(light) + 1u;
    uint random = hashPair(hashPair(key.y, key.x), params.frame);
    vec3 thresholds = vec3(random & 1023u, bitfieldExtract(random, 10, 10), bitfieldExtract(random, 20, 10)) / 1024.0;

    bool touched = ((mark >> kMarkMovedShift) & kMarkMovedFrames) != 0u;
    count = (mark & kFaceMoved) != 0u ? min(count, params.moved_window)
            : touched                 ? min(count, params.touched_window)
                                      : count;
    uint weight = min(count, params.window);
    words.data[2u * slot + 1u] =
        packUint2x32(packKept(towards(keptRadiance(light), sampled, weight), weight, thresholds));
    vec3 recent = towards(recentRadiance(state.recent), sampled, min(count, kRecentSamples));
    params.states.data[slot] = FaceState(mark, packRecent(recent, thresholds));
}
