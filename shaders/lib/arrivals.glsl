// SPDX-License-Identifier: MIT
// Finds the subgroup that arrives last of a dispatch, so that it can use what all others have made. Nobody waits. Words
// that several subgroups touch in the dispatch are touched by atomics alone.
// At the end of a kernel, where every thread of the counted workgroups is:
//
//   uint here = arrivingThreads();
//   uint before = subgroupElect() ? atomicAdd(counters.arrived, here) : 0u; // cleared before the dispatch
//   if (areLastThreads(before, here, groups * gl_WorkGroupSize.x)) ...
#ifndef ZVO_SHADERS_LIB_ARRIVALS_GLSL
#define ZVO_SHADERS_LIB_ARRIVALS_GLSL

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

// The number of this subgroup's threads. Their atomics on buffers come before what they do next.
uint arrivingThreads()
{
    memoryBarrierBuffer();
    subgroupBarrier();
    return subgroupBallotBitCount(subgroupBallot(true));
}

// before: what the elected thread got. threads: of all counted workgroups.
bool areLastThreads(uint before, uint here, uint threads)
{
    bool last = subgroupBroadcastFirst(before) + here == threads;
    memoryBarrierBuffer();
    return last;
}

#endif
