#version 460
// SPDX-License-Identifier: MIT
// From what a traversal of a DAG knows of a hit, the number of a voxel in its leaf, to the index of its attributes: the
// rank of the voxel, or of the node where a level of detail stopped. For lists of rays, a thread a hit, and for pictures
// where trace/primary_ranks does not do it, one workgroup a live tile.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"

layout(constant_id = 0) const uint kNodeLevels = 5u;  // at least 2
layout(constant_id = 1) const bool kDetail = false;   // hits may be nodes
layout(constant_id = 2) const bool kTiles = true;     // of a picture
layout(constant_id = 3) const uint kEntriesPerWord = 2u; // of lists

#include "lib/ranks.glsl"

layout(local_size_x = kTilePixels) in;
layout(push_constant, scalar) uniform Push
{
    RanksParams params;
};

// The number in its block of the cell, at some level, that contains a cell of a lower one.
uint cellAt(uvec3 cell, uint cell_level, uint level)
{
    return cellInBlock(cell >> (2u * (cell_level - level)));
}

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
    else if (i >= params.width)
        return;
    Hit hit = loadHit(Hit_ConstPtr(uint64_t(params.hits)), i);
    if (isMiss(hit))
        return;
    uvec3 cell = hitCell(hit);
    uint level = kDetail ? hitLevel(hit) : kNodeLevels;
    RankedNode at = RankedNode(0u, 0u, 0u);
    for (uint above = 0u; above + 2u < kNodeLevels; ++above)
        if (above < level)
            descend(params.source, cellAt(cell, level, above + 1u), at);
    if (level + 1u >= kNodeLevels)
        descendToLeaf(params.source, cellAt(cell, level, kNodeLevels - 1u), kDetail, at);
    bool voxel = level == kNodeLevels;
    uint_Ptr(uint64_t(params.hits)).data[4u * i + 1u] = voxel ? at.voxels + hit.index : at.rank;
}
