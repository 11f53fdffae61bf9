#version 460
// SPDX-License-Identifier: MIT
// Replaces the index that a traversal of a DAG gives a hit, the number of a voxel in its leaf, by the index of the
// hit's attributes: the rank of the voxel, or of the node where a level of detail has stopped the ray. Runs over lists
// of rays, a thread for each hit, and over pictures for which trace/primary_ranks cannot be used, a workgroup for each
// live tile.
//
// Overlays (update/update.h) may stand above the DAG. Their nodes have attributes of their own, and so have the voxels
// in their leaves, whose numbers the traversal has found already. What hangs below a list begins with the rank of the
// node that the overlay's is a copy of.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

layout(constant_id = 0) const uint kNodeLevels = 5u;  // at least 2
layout(constant_id = 1) const bool kDetail = false;   // hits may be nodes
layout(constant_id = 2) const bool kTiles = true;     // of a picture
layout(constant_id = 3) const uint kEntriesPerWord = 2u; // of lists
layout(constant_id = 4) const bool kOverlays = false; // the upper nodes may be those of an overlay
layout(constant_id = 5) const bool kCounted = false;  // the device knows how many hits the list has

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
    else
    {
        uint hit_count = params.hit_count;
        if (kCounted)
            hit_count = params.list_length.data[0];
        if (i >= hit_count)
            return;
    }
    Hit hit = loadHit(Hit_ConstPtr(uint64_t(params.hits)), i);
    if (isMiss(hit))
        return;
    uvec3 cell = hitCell(hit);
    uint level = kDetail ? hitLevel(hit) : kNodeLevels;
    RankedNode at = RankedNode(0u, 0u, 0u);
    bool in_overlay = kOverlays;
    for (uint above = 0u; above + 2u < kNodeLevels; ++above)
    {
        if (above < level)
        {
            uint child = cellAt(cell, level, above + 1u);
            in_overlay = in_overlay && descendInOverlay(params.source, params.overlay_ranks, child, at);
            if (!in_overlay)
                descend(params.source, child, at);
        }
    }
    if (level + 1u >= kNodeLevels)
    {
        uint leaf = cellAt(cell, level, kNodeLevels - 1u);
        in_overlay = in_overlay && descendInOverlay(params.source, params.overlay_ranks, leaf, at);
        if (!in_overlay)
            descendToLeaf(params.source, leaf, kDetail, at);
    }
    uint voxel = hit.index + (in_overlay ? 0u : at.voxels);
    uint node = in_overlay ? at.node + params.attribute_offset : at.rank;
    uint_Ptr(uint64_t(params.hits)).data[4u * i + 1u] = level == kNodeLevels ? voxel : node;
}
