#version 460
// SPDX-License-Identifier: MIT
// Adds a sample to the means of each face that the frame takes, and to the sums of its brick. Later samples weigh more,
// the n-th as much as its number: the light that faces reflect to each other is still dim in the first ones.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceUpdateParams, GPU_NO_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/sampling.glsl"

#define FACES_BINDING 0
#define STATES_BINDING 1
#include "path/lists.glsl"
#include "radiance/brick.glsl"
#include "radiance/face_table.glsl"
#include "radiance/cached_face.glsl"

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
    uvec2 key = loadFace(slot).key;
    FaceState state = loadFaceState(slot);
    uint mark = markAfter(state.mark, number);
    vec3 sampled = params.radiance.data[i];
    uvec2 seeds = seedsOfFace(key);
    vec3 thresholds = thresholdsOf(hashPair(hashPair(seeds.y, seeds.x), params.frame));

    uint before = cachedWeight(state.own);
    uint count = before + 1u;
    bool touched = ((mark >> kMarkMovedShift) & kMarkMovedFrames) != 0u;
    count = (mark & kFaceMoved) != 0u ? min(count, params.moved_window)
            : touched                 ? min(count, params.touched_window)
                                      : count;
    uint weight = min(count, params.window);
    vec3 last = cachedRadiance(state.own);
    vec3 own = towards(last, sampled, weight);
    vec3 recent = towards(recentRadiance(state.recent), sampled, min(count, kRecentSamples));

    uvec3 cell = cellOfFace(key);
    CachedFace around;
    uint brick;
    vec4 sum = lightBetweenFaces(cell >> 2, normalOfFace(key), (vec3(cell & 3u) + 0.5) / 4.0, 1u, brick, around);
    vec3 brick_light = sum.rgb / max(sum.w, 1e-6);
    BrickSpread spread = spreadOf(luminance(sampled), luminance(last), luminance(brick_light));
    float brick_samples = 0.0;
    if (brick != kNoFace)
    {
        FaceState state_of_brick = loadFaceState(brick);
        uint spread_samples;
        BrickSpread known = spreadIn(state_of_brick.own, spread_samples);
        brick_samples = samplesOfBrick(known, spread_samples);
        bool is_spread = sum.w > 0.0 && before != 0u;
        uint counts = kSumOfSample + (touched && params.touched_window < params.window ? kSumOfMove : 0u) +
                      (is_spread ? kSumOfSpread : 0u);
        addLight(params.sums, state_of_brick.recent, stepOfBrick(around.light), sampled, thresholds, counts);
        if (is_spread)
            addSpread(params.sums, state_of_brick.recent, spread, thresholds.xy);
    }
    precise vec3 shown = mix(own, brick_light, sum.w > 0.0 ? shareOfBrick(float(weight), brick_samples) : 0.0);

    uint64_t_Ptr(uint64_t(params.faces)).data[2u * slot + 1u] = packUint2x32(packCached(shown, weight, thresholds));
    params.states.data[slot] = FaceState(mark, packRecent(recent, thresholds), packCached(own, weight, thresholds));
}
