// SPDX-License-Identifier: MIT
// Sums over the threads of a workgroup of kAliasGroup threads. The includer includes light/alias.glsl before.
#ifndef ZVO_SHADERS_LIGHT_ALIAS_SCAN_GLSL
#define ZVO_SHADERS_LIGHT_ALIAS_SCAN_GLSL

#include "light/alias.glsl"
#include "light/environment.h"

shared AliasSums s_sums[kAliasGroup];

// The sums of the threads before this one; total: of all threads. Call in uniform control flow.
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
