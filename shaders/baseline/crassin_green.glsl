// SPDX-License-Identifier: MIT
// What the kernels of Crassin and Green have in common: parameters, and the way down to a fragment's node.
#ifndef ZVO_SHADERS_BASELINE_CRASSIN_GREEN_GLSL
#define ZVO_SHADERS_BASELINE_CRASSIN_GREEN_GLSL

#include "baseline/crassin_green.h"

GPU_ENTRY(CrassinGreenParams, GPU_NO_CONSTANTS);
layout(local_size_x = kCrassinGreenGroup) in;

const uint kNoNode = ~0u;

// The node at a level, from the root down; kNoNode where a tile found no room.
uint nodeOf(VoxelFragment fragment, uint level)
{
    uvec3 voxel = uvec3(fragment.xy & 65535u, fragment.xy >> 16, fragment.z);
    uint node = 0u;
    for (uint l = 1u; l <= level && node != kNoNode; ++l)
    {
        uvec3 bits = (voxel >> (params.depth - l)) & 1u;
        uint tile = params.nodes.data[node].child;
        node = tile == 0u ? kNoNode : tile + (bits.x | (bits.y << 1) | (bits.z << 2));
    }
    return node;
}

#endif
