// SPDX-License-Identifier: MIT
// Threads that share a brick: each takes kLaneLeaves of its leaves, which follow each other. Barriers are expensive on
// CPUs, and loads one after the other on GPUs.
// Needs params.masks, with binding 0 in the bound form, and kBrickLanes, 2 or more: a lane's leaves fit one word.
#ifndef ZVO_SHADERS_VOXELIZE_BRICK_LANES_GLSL
#define ZVO_SHADERS_VOXELIZE_BRICK_LANES_GLSL

#include "lib/bound.glsl"
#include "voxelize/bricks.h"

// The mask of a leaf of a brick.
#ifdef BOUND
TEXELS_2(0, masks);
#define MASKS(I) texelFetch(texels2_masks, int(I)).xy
#else
#define MASKS(I) uvec2_ConstPtr(uint64_t(params.masks)).data[I]
#endif

const uint kLaneLeaves = kBrickLeaves / kBrickLanes;
const int kSecondCount = 16; // a brick has at most 4096 voxels: two counts fit one word

shared uint s_brick_counts[kBricksGroup];

uint laneOfBrick()
{
    return gl_LocalInvocationIndex % kBrickLanes;
}

// The sum of counts over the threads of a brick before this one. total: over all of them. Call once, in uniform control
// flow.
uint countsBefore(uint counts, out uint total)
{
    s_brick_counts[gl_LocalInvocationIndex] = counts;
    barrier();
    uint first = gl_LocalInvocationIndex - laneOfBrick();
    uint before = 0u;
    total = 0u;
    for (uint lane = 0u; lane < kBrickLanes; ++lane)
    {
        before = lane == laneOfBrick() ? total : before;
        total += s_brick_counts[first + lane];
    }
    return before;
}

#endif
