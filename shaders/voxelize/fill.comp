#version 460
// SPDX-License-Identifier: MIT
// Finds the voxels that are inside: kFillLanes threads take a column of bricks from the top down, each 32 of its lines,
// and add up the triangles that cross them, as binary digits of 32 lines at once. Bricks that are not listed change
// nothing. A voxel with a crossing counts as its upper end: it is one of the surface in any case. With kCentres it
// counts as its centre, and voxels of the surface whose centres are outside are taken from the masks.
//
// With kFillRobust, columns stand along all axes, and a line is walked twice: the sum of all of its crossings tells in
// the second walk what a ray from a voxel down has crossed, which of closed surfaces is the same as from there up.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(FillParams, VOXELIZE_FILL_CONSTANTS);
layout(local_size_x = kBricksGroup) in;

#define BRICKS_BINDING 0
#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/fill_columns.glsl"

#ifdef BOUND
STORAGE(2, uvec4, crossings);
STORAGE(3, uvec4, masks);
#define CROSSINGS(I) storage_crossings.data[I]
#define MASKS(I) storage_masks.data[I]
#else
#define CROSSINGS(I) uvec4_Ptr(uint64_t(params.crossings)).data[I]
#define MASKS(I) uvec4_Ptr(uint64_t(params.masks)).data[I]
#endif

const uint kWindingBits = kFillPlanes + 7u; // 32 at most
const uint kPlanePairs = kBrickLeaves / 2u; // of leaves, of a plane

uint g_winding[kWindingBits]; // the winding numbers of 32 lines, binary digits from the lowest up; two's complement
uint g_all[kWindingBits];     // with kFillRobust, behind all triangles
uint g_exceeded = 0u;

const bool kRobust = kFill == kFillRobust;

uint rangeQuads() // of a range's crossings
{
    return fillWords(kFillPlanes, kRobust, kCentres) / 4u;
}

// Words of a pair of leaves that stand side by side along x: of either z half, of either leaf. Of a layer they have
// eight lines each, bits 0, 1, 4, 5, 8, 9, 12 and 13 from the layer's first bit on.
const uint kLayerBits = 0x3333u;

int firstBit(uint layer)
{
    return int((layer >> 1) * 16u + (layer & 1u) * 2u);
}

uint linesOf(uvec4 words, uint layer)
{
    uvec4 bits = (words >> firstBit(layer)) & kLayerBits;
    return bits.x | (bits.y << 2) | (bits.z << 16) | (bits.w << 18);
}

uvec4 wordsOf(uint lines, uint layer)
{
    return (uvec4(lines, lines >> 2, lines >> 16, lines >> 18) & kLayerBits) << firstBit(layer);
}

uint insideLines()
{
    uint any_digit = g_winding[0];
    if (kFill != kFillParity)
        [[unroll]] for (uint k = 1u; k < kWindingBits; ++k)
            any_digit |= g_winding[k];
    return any_digit;
}

// Those of which the ray down says that they are inside.
uint insideBelow()
{
    uint any_digit = 0u;
    [[unroll]] for (uint k = 0u; k < kWindingBits; ++k)
        any_digit |= g_winding[k] ^ g_all[k];
    return any_digit;
}

// Adds the counts of triangles that face up, and takes away those of triangles that face down.
void cross(uvec4 up[kFillPlanes], uvec4 down[kFillPlanes], uint layer)
{
    uint carry = 0u;
    uint borrow = 0u;
    [[unroll]] for (uint k = 0u; k < kWindingBits; ++k)
    {
        uint added = 0u;
        uint taken = 0u;
        if (k < kFillPlanes)
        {
            added = linesOf(up[min(k, kFillPlanes - 1u)], layer);
            taken = linesOf(down[min(k, kFillPlanes - 1u)], layer);
        }
        uint digit = g_winding[k];
        uint sum = digit ^ added ^ carry;
        carry = (digit & added) | (carry & (digit ^ added));
        g_winding[k] = sum ^ taken ^ borrow;
        borrow = (~sum & taken) | (borrow & ~(sum ^ taken));
    }
    g_exceeded |= g_winding[kWindingBits - 1u] ^ g_winding[kWindingBits - 2u];
}

// Lines whose centres are inside, of which the voxel's upper ends are as g_winding says. up, down: as of cross(), of
// crossings above the centres.
uint insideCentres(uvec4 up[kFillPlanes], uvec4 down[kFillPlanes], uint layer)
{
    uint carry = 0u;
    uint borrow = 0u;
    uint any_digit = 0u;
    [[unroll]] for (uint k = 0u; k < (kFill == kFillParity ? 1u : kWindingBits); ++k)
    {
        uint added = 0u;
        uint taken = 0u;
        if (k < kFillPlanes)
        {
            added = linesOf(up[min(k, kFillPlanes - 1u)], layer);
            taken = linesOf(down[min(k, kFillPlanes - 1u)], layer);
        }
        uint digit = g_winding[k];
        uint sum = digit ^ added ^ carry;
        carry = (digit & added) | (carry & (digit ^ added));
        any_digit |= sum ^ taken ^ borrow;
        borrow = (~sum & taken) | (borrow & ~(sum ^ taken));
    }
    return any_digit;
}

// The pair of leaves of a lane in a row of leaves: lanes take x1, z0 and z1 of the leaves' numbers.
uint pairOf(uint lane, uint row)
{
    uint leaf = ((lane & 1u) << 3) | ((lane & 2u) << 1) | ((lane & 4u) << 3) | ((row & 1u) << 1) | ((row & 2u) << 3);
    return leaf >> 1;
}

// number: of the range. first: of its planes. writes: the planes become masks of what is inside.
void fillBrick(uint number, uint first, uint lane, bool writes)
{
    for (uint row = 4u; row-- > 0u;)
    {
        uint pair = first + pairOf(lane, row);
        uvec4 up[kFillPlanes];
        uvec4 down[kFillPlanes];
        [[unroll]] for (uint k = 0u; k < kFillPlanes; ++k)
        {
            up[k] = CROSSINGS(pair + k * kPlanePairs);
            down[k] = CROSSINGS(pair + (kFillPlanes + k) * kPlanePairs);
        }
        uvec4 up_above[kFillPlanes];
        uvec4 down_above[kFillPlanes];
        if (kCentres)
            [[unroll]] for (uint k = 0u; k < kFillPlanes; ++k)
            {
                up_above[k] = CROSSINGS(pair + (2u * kFillPlanes + k) * kPlanePairs);
                down_above[k] = CROSSINGS(pair + (3u * kFillPlanes + k) * kPlanePairs);
            }
        uvec4 inside = uvec4(0u);
        uvec4 inside_below = uvec4(0u);
        [[unroll]] for (uint i = 0u; i < 4u; ++i)
        {
            if (kCentres)
                inside |= wordsOf(insideCentres(up_above, down_above, 3u - i), 3u - i);
            else
                inside |= wordsOf(insideLines(), 3u - i);
            if (kRobust)
                inside_below |= wordsOf(insideBelow(), 3u - i);
            cross(up, down, 3u - i);
        }
        if (writes)
            CROSSINGS(pair) = inside;
        if (kCentres)
        {
            uint mask_pair = number * ((kMixed ? 2u : 1u) * kPlanePairs) + pairOf(lane, row);
            MASKS(mask_pair) &= inside;
            if (kMixed)
                MASKS(mask_pair + kPlanePairs) &= inside;
        }
        if (kRobust && writes)
            CROSSINGS(pair + kFillPlanes * kPlanePairs) = inside_below;
    }
}

// Tells the nodes below a brick whether they are inside.
void leaveBrick(uint number, uvec3 column, int y)
{
    if (kRobust)
    {
        uint rays = bitCount(insideLines()) + bitCount(insideBelow());
        if (rays != 0u)
            atomicAdd(CROSSINGS((number + 1u) * rangeQuads() - kFacesWords / 4u)[column.z], rays);
        return;
    }
    bool is_open = insideLines() != ~0u;
    if (is_open && !setInColumn(column, kPartOpen, uint(y) >> kPartLog2, uint(y) & 63u))
        atomicAdd(params.counters.data[0].overflow_count, 1u);
}

void main()
{
    const uint lanes = kRobust ? kFillAxes * kFillLanes : kFillLanes;
    uint number = threadIndex() / lanes;
    if (number >= params.counters.data[0].listed_count)
        return;
    uint lane = threadIndex() % kFillLanes;
    uint line = kRobust ? threadIndex() % lanes / kFillLanes : 0u;
    uvec3 brick = turned(brickCell(keyOf(loadBrick(params.ranges.data[number].entry)), brickLevel()), line);
    uvec3 column = uvec3(brick.xz, line);
    int y = int(brick.y);
    if (brickFrom(column, y + 1) != kNoBrick)
        return; // not the highest of its column
    [[unroll]] for (uint k = 0u; k < kWindingBits; ++k)
        g_winding[k] = 0u;
    uint highest = number;
    bool writes = !kRobust; // in the second walk
    while (y != kNoBrick)
    {
        fillBrick(number, number * rangeQuads() + line * (2u * kFillPlanes * kPlanePairs), lane, writes);
        if (writes)
            leaveBrick(number, column, y);
        y = brickTo(column, y - 1);
        if (y != kNoBrick)
        {
            BrickEntry next;
            brickFind(brickKey(turnedBack(uvec3(brick.x, uint(y), brick.z), line), brickLevel()), next);
            number = next.mask_lo;
        }
        else if (!writes)
        {
            [[unroll]] for (uint k = 0u; k < kWindingBits; ++k)
            {
                g_all[k] = g_winding[k];
                g_winding[k] = 0u;
            }
            writes = true;
            y = int(brick.y);
            number = highest;
        }
    }
    if (g_exceeded != 0u)
        atomicMax(params.counters.data[0].crossings_exceeded, 1u);
    uint open_lines = bitCount(insideLines());
    if (open_lines != 0u)
        atomicAdd(params.counters.data[0].open_lines, open_lines);
}
