// SPDX-License-Identifier: MIT
// Numbers of workgroups and threads of dispatches that were folded from one dimension into two, and the arguments of
// such dispatches.
#ifndef ZVO_SHADERS_LIB_DISPATCH_GLSL
#define ZVO_SHADERS_LIB_DISPATCH_GLSL

#include "shared/gpu.h"

// Number of this workgroup in dispatch order.
uint workgroupIndex()
{
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Number of this thread in dispatch order; it may be past the requested thread count. This is a macro, because glslang
// silently takes gl_WorkGroupSize for 1 in functions before the kernel's local size.
#define threadIndex()                                                                                                  \
    (workgroupIndex() * (gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z) + gl_LocalInvocationIndex)

// A permutation of 0 .. count - 1 that gives neighbours to different halves of the dispatch: devices that hand each
// thread a contiguous range of workgroups then share uneven work evenly.
uint interleave(uint index, uint count)
{
    uint half_count = (count + 1u) / 2u;
    return index < half_count ? 2u * index : 2u * (index - half_count) + 1u;
}

// The arguments of an indirect dispatch of this many workgroups, folded so.
DispatchArgs foldedArgs(uint groups, uint max_groups_x)
{
    uint rows = (groups + max_groups_x - 1u) / max_groups_x;
    return DispatchArgs(rows > 1u ? max_groups_x : groups, rows, 1u);
}

#endif
