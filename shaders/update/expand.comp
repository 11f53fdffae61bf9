#version 460
// SPDX-License-Identifier: MIT
// Writes the children of each touched node of a level. In the end, the child counts of blocks of nodes have become their
// exclusive prefix sum, and the next level has its size.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(ExpandParams, UPDATE_EXPAND_CONSTANTS);
layout(local_size_x = kUpdateGroup) in;

#include "lib/arrivals.glsl"
#include "lib/dispatch.glsl"
#extension GL_KHR_shader_subgroup_arithmetic : require

const bool kRanks = kEntriesPerWord != 0u && kAttributes;

#include "update/expand.glsl"

// By one subgroup. Returns the sum of all counts; wrapped: it is past 2^32.
uint scanBlocks(uint block_count, out bool wrapped)
{
    uint carry = 0u;
    wrapped = false;
    for (uint first = 0u; first < block_count; first += gl_SubgroupSize)
    {
        uint i = params.first_partial + first + gl_SubgroupInvocationID;
        bool is_block = first + gl_SubgroupInvocationID < block_count;
        uint value = is_block ? atomicAdd(params.partials.data[i], 0u) : 0u;
        uint before = subgroupExclusiveAdd(value);
        uint total = subgroupAdd(value);
        if (is_block)
            atomicExchange(params.partials.data[i], carry + before);
        wrapped = wrapped || carry + total < carry;
        carry += total;
    }
    return carry;
}

void main()
{
    OverlayLevel level = params.state.data[0].levels[params.level];
    LevelRange range = params.ranges.data[params.state.data[0].level_count - params.level]; // of the parents
    if (workgroupIndex() >= range.count)
        return;
    uint entry = params.items.data[range.first + workgroupIndex()].entry;
    uint child;
    uint count = expandChild(entry, gl_LocalInvocationIndex, kLeaves, child);
    if (count != 0u)
        atomicAdd(params.partials.data[params.first_partial + (child - level.first_node) / kScanBlock], count);
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.state.data[0].arrived[params.level], here) : 0u;
    if (areLastThreads(before, here, range.count * kUpdateGroup))
    {
        bool wrapped;
        uint children = scanBlocks((level.node_count + kScanBlock - 1u) / kScanBlock, wrapped);
        if (subgroupElect())
            sizeNextLevel(params.level, level, children, wrapped);
    }
}
