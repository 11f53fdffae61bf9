#version 460
// SPDX-License-Identifier: MIT
// Counts the cells of a level with something below them, for each workgroup. With the prefix sums over these counts,
// nodes have the same numbers on every run; the thesis counts with an atomic while it builds (baseline/thesis_level).
#extension GL_GOOGLE_include_directive : require
#include "baseline/thesis.h"

GPU_ENTRY(ThesisCountParams, BASELINE_THESIS_COUNT_CONSTANTS);
layout(local_size_x = kThesisLevelGroup) in;

#define SCAN_GROUP kThesisLevelGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"
#include "baseline/thesis_cells.glsl"

void main()
{
    uint index = threadIndex();
    bool occupied = false;
    if (index < params.cell_count)
    {
        uint first = kTileNodes * (params.first_cell + index);
        [[unroll]] for (uint i = 0u; i < kTileNodes; ++i)
            occupied = isOccupied(first + i) || occupied;
    }
    uint total;
    workgroupExclusiveAdd(occupied ? 1u : 0u, total);
    if (gl_LocalInvocationIndex == 0u && index < params.cell_count)
        params.partials.data[workgroupIndex()] = total;
}
