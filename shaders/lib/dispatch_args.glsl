// SPDX-License-Identifier: MIT
// Arguments of indirect dispatches.
#ifndef ZVO_SHADERS_LIB_DISPATCH_ARGS_GLSL
#define ZVO_SHADERS_LIB_DISPATCH_ARGS_GLSL

#include "shared/gpu.h"

// For this many workgroups, folded from one dimension into two as lib/dispatch.glsl numbers them.
DispatchArgs foldedArgs(uint groups, uint max_groups_x)
{
    uint rows = (groups + max_groups_x - 1u) / max_groups_x;
    return DispatchArgs(rows > 1u ? max_groups_x : groups, rows, 1u);
}

#endif
