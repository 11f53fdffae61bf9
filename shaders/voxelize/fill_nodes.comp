#version 460
// SPDX-License-Identifier: MIT
// Finds the children of nodes above bricks that no triangle may touch and that are inside: all of their lines are inside
// below the next brick above them, or with kFillRobust most rays along most axes say so.
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

// 1 if the cells from brick `low` on down to the next brick are inside, as lines along an axis say, -1 if they are
// outside, 0 if half of the rays say so.
int sideAt(uvec3 low, uint line)
{
    uvec3 brick = turned(low, line);
    uvec3 column = uvec3(brick.xz, line);
    int above = brickFrom(column, int(brick.y));
    bool is_open = above == kNoBrick || isInColumn(column, kPartOpen, above);
    // Above all bricks it is as below all of them the other way around.
    int asked = kRobust && above == kNoBrick ? brickFrom(column, 0) : above;
    bool is_half = kRobust && asked != kNoBrick && isInColumn(column, kPartHalf, asked);
    return is_half ? 0 : is_open ? -1 : 1;
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
    int side = 0;
    bool is_known = false; // of the child above
    uint undecided = 0u;
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
            side = sideAt(low, 0u);
            is_known = true;
        }
        is_known = is_known && !has_child;
        int sides = side;
        if (kRobust && !has_child && in_window)
        {
            sides += sideAt(low, 1u) + sideAt(low, 2u);
            undecided += sides == 0 ? 1u : 0u;
        }
        if (!has_child && in_window && sides > 0)
            full |= cell < 32u ? uvec2(1u << cell, 0u) : uvec2(0u, 1u << (cell & 31u));
    }
    if (undecided != 0u)
        atomicAdd(params.counters.data[0].undecided[params.height - 1u], undecided);
    if ((full.x | full.y) == 0u)
        return;
    atomicOr(BRICK_WORD(entry, kMaskWord), full.x);
    atomicOr(BRICK_WORD(entry, kMaskWord + 1u), full.y);
    atomicAdd(params.counters.data[0].full_nodes[params.height - 1u], bitCount(full.x) + bitCount(full.y));
}
