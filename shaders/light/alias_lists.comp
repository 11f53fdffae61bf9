#version 460
// SPDX-License-Identifier: MIT
// Lists light and heavy cells, each with what those before it lack or give.
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
    AliasSums before = add(params.sums.data[group], sumsBefore(sums, block));
    for (uint k = 0u; k < kAliasItems; ++k)
    {
        uint i = first + k;
        if (i < params.cell_count)
        {
            AliasSums own = sumsOf(normal, i, total);
            uint base = normal * params.cell_count;
            if (own.light_count != 0u)
                params.light.data[base + before.light_count] = AliasItem(before.lacks, i, 0u);
            else
                params.heavy.data[base + before.heavy_count] = AliasItem(before.gives, i, 0u);
            before = add(before, own);
        }
    }
}
