#version 460
// SPDX-License-Identifier: MIT
// Sums up what the cells of each block lack and give.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"

GPU_ENTRY(AliasParams, GPU_NO_CONSTANTS);
layout(local_size_x = kAliasGroup) in;

#include "lib/dispatch.glsl"
#include "light/alias.glsl"

void main()
{
    uint group = workgroupIndex();
    uint normal = group / params.block_count;
    if (normal >= kNormals)
        return;
    uint64_t total = totalOf(normal);
    uint first = (group % params.block_count) * kAliasBlock + gl_LocalInvocationIndex * kAliasItems;
    AliasSums sums = AliasSums(uint64_t(0), uint64_t(0), 0u, 0u);
    for (uint k = 0u; k < kAliasItems; ++k)
        if (first + k < params.cell_count)
            sums = add(sums, sumsOf(normal, first + k, total));
    AliasSums block;
    sumsBefore(sums, block);
    if (gl_LocalInvocationIndex == 0u)
        params.sums.data[group] = block;
}
