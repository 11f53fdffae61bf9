// SPDX-License-Identifier: MIT
// Numbers of workgroups and threads of dispatches that were folded from one dimension into two.

// Number of this workgroup in dispatch order.
uint workgroupIndex()
{
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Number of this thread in dispatch order; may lie past the thread count that was asked for. A macro, because glslang
// takes gl_WorkGroupSize for 1 without a word in functions that stand before the kernel's local size.
#define threadIndex()                                                                                                  \
    (workgroupIndex() * (gl_WorkGroupSize.x * gl_WorkGroupSize.y * gl_WorkGroupSize.z) + gl_LocalInvocationIndex)

// A permutation of 0 .. count - 1 that gives neighbours to different halves of the dispatch: devices that hand each
// thread a contiguous range of workgroups then share uneven work evenly.
uint interleave(uint index, uint count)
{
    uint half_count = (count + 1u) / 2u;
    return index < half_count ? 2u * index : 2u * (index - half_count) + 1u;
}
