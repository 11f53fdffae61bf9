// SPDX-License-Identifier: MIT
// Stores the result of an operation in a brick, a workgroup of which each thread has a leaf. Needs GPU_ENTRY with
// AlgebraParams.
#ifndef ZVO_SHADERS_ALGEBRA_STORE_MASK_GLSL
#define ZVO_SHADERS_ALGEBRA_STORE_MASK_GLSL

#include "algebra/algebra.h"

shared uint s_open; // 1: a voxel of the brick is empty

// Call in uniform control flow.
void storeMask(uint brick, uint entry, uvec2 mask)
{
    uint leaf = gl_LocalInvocationIndex;
    if (!kFilled)
    {
        params.brick_masks.data[brick * kBrickLeaves + leaf] = mask;
        return;
    }
    params.inside.data[brick * (2u * kBrickLeaves) + leaf] = mask;
    if (leaf == 0u)
        s_open = 0u;
    barrier();
    if ((mask.x & mask.y) != ~0u)
        atomicOr(s_open, 1u);
    barrier();
    if (leaf == 0u && s_open == 0u)
        atomicOr(params.full.data[entry >> 5], 1u << (entry & 31u));
}

#endif
