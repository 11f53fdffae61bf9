// SPDX-License-Identifier: MIT
// Finds the occupied entries of a brick table, kCollectItems for each thread of workgroups of kCollectGroup, and counts
// their voxels. To list them, a kernel takes room for a whole subgroup by one atomic; there are no barriers.
#ifndef ZVO_SHADERS_OCTREE_FOUND_BRICKS_GLSL
#define ZVO_SHADERS_OCTREE_FOUND_BRICKS_GLSL

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/brick_loads.glsl"
#include "lib/dispatch.glsl"
#include "octree/octree.h"

struct FoundBricks
{
    uint first;    // entry of the thread
    uint occupied; // bit i: entry first + i * kCollectGroup
    uvec2 before;  // entries and voxels that the subgroup's threads before this one found
    uvec2 total;   // that the subgroup found
};

// Call in uniform control flow.
FoundBricks findBricks(uint brick_capacity)
{
    FoundBricks found;
    found.first = workgroupIndex() * (kCollectGroup * kCollectItems) + gl_LocalInvocationIndex;
    found.occupied = 0u;
    uint voxels = 0u;
    for (uint i = 0u; i < kCollectItems; ++i)
    {
        uint entry = found.first + i * kCollectGroup;
        uint loaded = min(entry, brick_capacity - 1u); // no load waits for a condition, so many are under way
        BrickEntry brick = loadBrick(loaded);
        bool is_brick = entry < brick_capacity && brick.key != 0u;
        found.occupied |= is_brick ? 1u << i : 0u;
        voxels += is_brick ? bitCount(brick.mask_lo) + bitCount(brick.mask_hi) : 0u;
    }
    uvec2 count = uvec2(bitCount(found.occupied), voxels);
    found.before = subgroupExclusiveAdd(count);
    found.total = subgroupAdd(count);
    return found;
}

// Takes the next of the entries away from found. Without any, returns one of the workgroup's own: lanes that are switched
// off fetch texels too, but not those that other workgroups write.
uint takeBrick(inout FoundBricks found)
{
    uint entry = found.first + min(uint(findLSB(found.occupied)), kCollectItems - 1u) * kCollectGroup;
    found.occupied &= found.occupied - 1u;
    return entry;
}

#endif
