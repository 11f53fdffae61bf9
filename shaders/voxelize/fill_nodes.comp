#version 460
// SPDX-License-Identifier: MIT
// Finds the children of nodes above bricks that no triangle may touch and that are inside: all of their lines are inside
// below the next brick above them.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(FillNodesParams, VOXELIZE_FILL_NODES_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#define BRICKS_BINDING 0
#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "voxelize/fill_columns.glsl"

// Whether the cells from brick y of a column on down to the next brick are inside.
bool isInsideAt(uvec2 column, int y)
{
    int above = brickFrom(column, y);
    if (above == kNoBrick)
        return false;
    uvec2 open = columnMask(column, kPartOpen, uint(above) >> kPartLog2);
    uint bit = uint(above) & 63u;
    return (((bit < 32u ? open.x : open.y) >> (bit & 31u)) & 1u) == 0u;
}

void main()
{
    LevelRange range = params.ranges.data[params.height];
    if (threadIndex() >= range.count)
        return;
    uint entry = params.items.data[range.first + threadIndex()].entry;
    BrickEntry node = loadBrick(entry);
    uvec3 corner = brickCell(keyOf(node), brickLevel() - params.height) << 2; // in cells of the children
    uint size_log2 = 2u * params.height - 2u;                                // of a child, in bricks
    ivec3 window_low = ivec3(0);
    ivec3 window_high = ivec3(gridResolution() - 1);
    clipToWindow(window_low, window_high);
    uvec3 first_brick = uvec3(window_low >> int(kBrickLog2));
    uvec3 last_brick = uvec3(window_high >> int(kBrickLog2));
    uvec2 full = uvec2(0u);
    bool is_inside = false;
    bool is_known = false; // of the child above
    for (uint i = 0u; i < kBrickLeaves; ++i)
    {
        uvec3 place = uvec3((i >> 2) & 3u, 3u - (i & 3u), i >> 4);
        uint cell = cellInBlock(place);
        bool has_child = (((cell < 32u ? node.mask_lo : node.mask_hi) >> (cell & 31u)) & 1u) != 0u;
        uvec3 low = (corner + place) << size_log2;
        uvec3 high = low + ((1u << size_log2) - 1u);
        bool in_window = all(greaterThanEqual(low, first_brick)) && all(lessThanEqual(high, last_brick));
        is_known = is_known && (i & 3u) != 0u;
        if (!has_child && in_window && !is_known)
        {
            is_inside = isInsideAt(low.xz, int(low.y));
            is_known = true;
        }
        is_known = is_known && !has_child;
        if (!has_child && in_window && is_inside)
            full |= cell < 32u ? uvec2(1u << cell, 0u) : uvec2(0u, 1u << (cell & 31u));
    }
    if ((full.x | full.y) == 0u)
        return;
    atomicOr(BRICK_WORD(entry, kMaskWord), full.x);
    atomicOr(BRICK_WORD(entry, kMaskWord + 1u), full.y);
    atomicAdd(params.counters.data[0].full_nodes[params.height - 1u], bitCount(full.x) + bitCount(full.y));
}
