// SPDX-License-Identifier: MIT
// What the kernels for alias tables share (light/environment.h).
// Needs params.weights, params.totals and params.cell_count.
#ifndef ZVO_SHADERS_LIGHT_ALIAS_GLSL
#define ZVO_SHADERS_LIGHT_ALIAS_GLSL

#include "light/environment.h"

// The weight in steps of cell i of a normal.
uint weightOf(uint normal, uint i)
{
    return params.weights.data[normal * params.cell_count + i];
}

// The sum of all weights of a normal, in steps.
uint64_t totalOf(uint normal)
{
    return uint64_t(params.totals.data[0].low_sums[normal]) +
           (uint64_t(params.totals.data[0].high_sums[normal]) << (kWeightBits / 2u));
}

AliasSums add(AliasSums a, AliasSums b)
{
    return AliasSums(a.lacks + b.lacks, a.gives + b.gives, a.light_count + b.light_count,
                     a.heavy_count + b.heavy_count);
}

// A cell's own. Weights are compared with the mean times the number of cells.
AliasSums sumsOf(uint normal, uint i, uint64_t total)
{
    uint64_t weight = uint64_t(weightOf(normal, i)) * params.cell_count;
    bool light = weight <= total;
    return AliasSums(light ? total - weight : uint64_t(0), light ? uint64_t(0) : weight - total, light ? 1u : 0u,
                     light ? 0u : 1u);
}

shared AliasSums s_sums[kAliasGroup];

// The sums of the threads of a workgroup of kAliasGroup threads before this one; total: of all threads. Call in uniform
// control flow.
AliasSums sumsBefore(AliasSums own, out AliasSums total)
{
    uint i = gl_LocalInvocationIndex;
    AliasSums sums = own;
    barrier(); // the array may still be read by an earlier call
    s_sums[i] = sums;
    for (uint distance = 1u; distance < kAliasGroup; distance *= 2u)
    {
        barrier();
        AliasSums other = s_sums[i >= distance ? i - distance : 0u];
        if (i >= distance)
            sums = add(sums, other);
        barrier();
        s_sums[i] = sums;
    }
    barrier();
    total = s_sums[kAliasGroup - 1u];
    return AliasSums(sums.lacks - own.lacks, sums.gives - own.gives, sums.light_count - own.light_count,
                     sums.heavy_count - own.heavy_count);
}

#endif
