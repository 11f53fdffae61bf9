#version 460
// SPDX-License-Identifier: MIT
// Adds the sums of the frame to the means of the bricks of a level, and the means of the sums to the sums of the bricks
// around them. Then the sums are 0 again, and the bricks are not listed.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceUpdateBricksParams, GPU_NO_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/dispatch.glsl"
#include "lib/sampling.glsl"
#include "path/lists.glsl"
#include "radiance/brick.glsl"
#include "radiance/face_table.glsl"
#include "radiance/cached_face.glsl"

// The weight of the last `added` of so many samples, in a mean in which the n-th weighs as much as its number.
float weightOfLast(uint added, uint samples)
{
    float last = float(min(added, samples));
    float all = float(samples);
    return last * (2.0 * all - last + 1.0) / (all * (all + 1.0));
}

// FaceState::own of the brick with what the sums tell.
uvec2 spreadAfter(uvec2 words, BrickSum sum, uint random)
{
    uint count = sum.counts / kSumOfSpread;
    uint before;
    BrickSpread spread = spreadIn(words, before);
    uint samples = min(before + count, kCachedWeightMax);
    precise vec2 added = vec2(sum.total, sum.between) / float((1u << kSpreadShift) * max(count, 1u));
    precise vec2 mean = mix(vec2(spread.total, spread.between), added, weightOfLast(count, max(samples, 1u)));
    return count == 0u ? words : packSpread(BrickSpread(mean.x, mean.y), samples, random & 1023u);
}

void main()
{
    uint i = threadIndex();
    if (i >= listLength(kFirstBricks + params.level - 1u, kListPaths))
        return;
    uint slot = params.bricks.data[i];
    BrickSum sum = params.sums.data[i];
    params.sums.data[i] = BrickSum(uvec3(0u), 0u, 0, 0);
    CachedFace face = loadFace(slot);
    uvec2 own = params.states.data[slot].own;
    uvec2 seeds = seedsOfFace(face.key);
    uint random = hashPair(hashPair(seeds.y, seeds.x), params.frame);
    params.states.data[slot] = FaceState(params.frame & kMarkFrames, 0u, spreadAfter(own, sum, random));
    uint added = sum.counts & (kSumOfMove - 1u);
    if (added == 0u)
        return;

    vec3 thresholds = thresholdsOf(random);
    uint moved = sum.counts & (kSumOfSpread - kSumOfMove);
    uint samples = min(cachedWeight(face.light) + added, moved != 0u ? params.moved_window : params.window);
    precise vec3 sampled = vec3(sum.light) * (stepOfBrick(face.light) / float(added));
    precise vec3 mean = mix(cachedRadiance(face.light), sampled, weightOfLast(added, samples));
    uint64_t_Ptr(uint64_t(params.faces)).data[2u * slot + 1u] = packUint2x32(packCached(mean, samples, thresholds));

    if (params.level < kBrickLevels)
    {
        CachedFace around;
        uint outer = findFace(cellOfFace(face.key) >> 2, normalOfFace(face.key), params.level + 1u, around);
        if (outer != kNoFace)
            addLight(params.outer_sums, params.states.data[outer].recent, stepOfBrick(around.light), sampled, thresholds,
                     kSumOfSample + (moved != 0u ? kSumOfMove : 0u));
    }
}
