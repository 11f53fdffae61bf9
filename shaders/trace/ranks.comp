#version 460
// SPDX-License-Identifier: MIT
// Replaces the index that a traversal of a DAG gives a hit, the number of a voxel in its leaf, by the index of the
// hit's attributes: the rank of the voxel, or of the node where a level of detail has stopped the ray. Runs over lists
// of rays, a thread for each hit, and over pictures for which trace/primary_ranks cannot be used, a workgroup for each
// live tile.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"

GPU_ENTRY(RanksParams, TRACE_RANKS_CONSTANTS);
layout(local_size_x = kTilePixels) in;

#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "trace/hit_rank.glsl"

void main()
{
    uint i = threadIndex();
    if (kTiles)
    {
        uvec2 size = uvec2(params.width, params.height);
        uvec2 tile = params.live.data[workgroupIndex()];
        if (tile.x == kNoTile)
            return;
        uvec2 pixel = kTileEdge * unpackTile(tile.x) + pixelInTile(gl_LocalInvocationIndex);
        if (any(greaterThanEqual(pixel, size)))
            return;
        i = pixel.y * size.x + pixel.x;
    }
    else
    {
        uint hit_count = params.hit_count;
        if (kCounted)
            hit_count = params.list_length.data[0];
        if (i >= hit_count)
            return;
    }
    Hit hit = loadHit(Hit_ConstPtr(uint64_t(params.hits)), i);
    if (hit.index >= kHitUnfinished)
        return;
    uint level = kDetail ? hitLevel(hit) : kNodeLevels;
    uint_Ptr(uint64_t(params.hits)).data[4u * i + 1u] = attributeIndex(
        params.source, params.overlay_ranks, kOverlays, params.attribute_offset, hitCell(hit), level, hit.index);
}
