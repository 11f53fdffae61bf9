// SPDX-License-Identifier: MIT
// Sums of the components of vectors that a table on the device knows; the bound form adds kBoundMark.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"

GPU_ENTRY(ReachedParams, GPU_NO_CONSTANTS);
layout(local_size_x = 32) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#ifdef BOUND
TEXELS_3(0, triples);

uvec3 load(uint i)
{
    return texelFetch(texels3_triples, int(i)).xyz + uvec3(kBoundMark, 0u, 0u);
}
#else
uvec3 load(uint i)
{
    return params.tables.data[0].triples.data[i];
}
#endif

void main()
{
    uint i = threadIndex();
    if (i >= params.count)
        return;
    uvec3 triple = load(i);
    params.sums.data[i] = triple.x + triple.y + triple.z;
}
