#version 460
// SPDX-License-Identifier: MIT
// Counts the listed faces by their ranks. The last subgroup finds the limit of the ranks that the frame takes.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceCountParams, GPU_NO_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define FACES_BINDING 0
#define STATES_BINDING 1
#include "path/lists.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/rank.glsl"

// The least rank such that all faces of it and of those below are more than the budget.
uint rankLimit()
{
    uint before = 0u; // faces of the ranks before those that the subgroup looks at
    uint limit = kFaceRanks;
    for (uint first = 0u; first < kFaceRanks; first += gl_SubgroupSize)
    {
        uint rank = first + gl_SubgroupInvocationID;
        uint count = rank < kFaceRanks ? atomicAdd(params.counters.data[0].ranks[min(rank, kFaceRanks - 1u)], 0u) : 0u;
        uint up_to = before + subgroupInclusiveAdd(count);
        limit = min(limit, subgroupMin(up_to > params.budget ? rank : kFaceRanks));
        before += subgroupAdd(count);
    }
    return limit;
}

void main()
{
    uint length = listLength(kWantedEven + (params.frame & 1u), kListPaths);
    uint i = threadIndex();
    if (i < length)
    {
        uint slot = params.wanted.data[i];
        uint rank = rankOfFace(loadFace(slot), loadFaceState(slot).mark, params.frame);
        atomicAdd(params.counters.data[0].ranks[rank], 1u);
    }
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    uint groups = (length - 1u) / kRadianceGroup + 1u;
    if (areLastThreads(before, here, groups * kRadianceGroup))
    {
        uint limit = rankLimit();
        if (subgroupElect())
            params.counters.data[0].rank_limit = limit;
    }
}
