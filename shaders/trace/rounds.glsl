// SPDX-License-Identifier: MIT
// Rays that used up the iterations of an invocation.
#ifndef ZVO_SHADERS_TRACE_ROUNDS_GLSL
#define ZVO_SHADERS_TRACE_ROUNDS_GLSL

#include "trace/trace.h"

// Schedules the next round over the same workgroups (numbered by lib/dispatch.glsl). If there is none, counts the ray
// as capped.
void endUnfinished(bool more, DispatchArgs_Ptr next_round, uint groups, TraceStatus_Ptr status)
{
    if (!more)
    {
        atomicAdd(status.data[0].capped_rays, 1u);
        return;
    }
    atomicMax(next_round.data[0].x, min(groups, kTilesFold));
    atomicMax(next_round.data[0].y, (groups - 1u) / kTilesFold + 1u);
    atomicMax(next_round.data[0].z, 1u);
}

#endif
