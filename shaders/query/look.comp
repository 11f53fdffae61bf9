#version 460
// SPDX-License-Identifier: MIT
// The attributes of what a list of questions has found.
#extension GL_GOOGLE_include_directive : require
#include "query/query.h"

GPU_ENTRY(LookParams, QUERY_LOOK_CONSTANTS);
layout(local_size_x = kQueryGroup) in;

#include "lib/attribute_formats.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/hit.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.hit_count)
        return;
    uint voxel = loadHit(params.hits, i).index;
    QueryLook look = QueryLook(Attribute(0u, 0u), 0u);
    if (voxel < kHitUnfinished)
    {
        look.stored = readAttribute(kFormat, true, params.attributes, params.nodes, voxel);
        if (uint64_t(params.emission_words) != 0ul && isEmissive(params.emission_words, voxel))
            look.emission = params.emission.data[emissionIndex(params.emission_words, voxel)];
    }
    params.looks.data[i] = look;
}
