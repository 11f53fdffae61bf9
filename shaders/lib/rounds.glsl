// SPDX-License-Identifier: MIT
// Rays that used up the iterations of an invocation. The includer includes trace/trace.h before.

// Schedules the next round, number `round`, over the same workgroups (numbered by lib/dispatch.glsl). If there is none,
// counts the ray as capped.
void endUnfinished(bool more, DispatchArgs_Ptr rounds, uint round, uint groups, TraceStatus_Ptr status)
{
    if (!more)
    {
        atomicAdd(status.data[0].capped_rays, 1u);
        return;
    }
    atomicMax(rounds.data[round].x, min(groups, kTilesFold));
    atomicMax(rounds.data[round].y, (groups - 1u) / kTilesFold + 1u);
    atomicMax(rounds.data[round].z, 1u);
}
