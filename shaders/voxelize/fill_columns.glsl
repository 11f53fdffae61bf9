// SPDX-License-Identifier: MIT
// Columns of bricks: which bricks of a column triangles may touch, in the brick table. A column has parts of 64 bricks,
// whose entries have a bit for each, a second entry for those bricks that are open below: not all of their lines are
// inside there, or with kFillRobust not most rays; and an entry for each 64 parts. Columns stand along y. For lines along
// z (1) and x (2) coordinates are turned, and a column is x, z and the lines' number.
// Needs what lib/bricks.glsl and voxelize/window.glsl need.
#ifndef ZVO_SHADERS_VOXELIZE_FILL_COLUMNS_GLSL
#define ZVO_SHADERS_VOXELIZE_FILL_COLUMNS_GLSL

#include "lib/bricks.glsl"
#include "voxelize/bricks.h"
#include "voxelize/window.glsl"

// Kinds of entries.
const uint kPartBricks = 0u;
const uint kPartOpen = 1u;
const uint kColumnParts = 2u;
const uint kPartHalf = 3u; // of bricks open below, those of which half of the rays say so

const uint kPartLog2 = 6u;
const uint kNarrowColumnBits = 8u; // of a brick's coordinate, as grids with narrow keys have at most 2^8 bricks an edge
const uint kWideColumnBits = 13u;
const uint kColumnLineShift = 24u;
const uint kColumnTag = 1u << 31;     // no narrow key of a node has it
const uint kWideColumnTag = 1u << 30; // nor the second word of a wide one
const int kNoBrick = -1;

// Turns coordinates so that the lines go along y.
uvec3 turned(uvec3 place, uint line)
{
    return line == 0u ? place : line == 1u ? place.yzx : place.zxy;
}

uvec3 turnedBack(uvec3 place, uint line)
{
    return turned(place, line == 0u ? 0u : 3u - line);
}

// The key of an entry of a column.
uvec2 columnKey(uvec3 column, uint kind, uint part)
{
    uint lines = column.z << kColumnLineShift;
    if (!kWideKeys)
        return uvec2(
            kColumnTag | (kind << 28) | lines | (part << 16) | (column.y << kNarrowColumnBits) | column.x, 0u);
    return uvec2((column.y << kWideColumnBits) | column.x, kWideColumnTag | lines | (kind << 16) | part) |
           kBrickKeyTag;
}

uvec2 columnMask(uvec3 column, uint kind, uint part)
{
    BrickEntry brick;
    bool found = brickFind(columnKey(column, kind, part), brick) != kNoEntry;
    return found ? uvec2(brick.mask_lo, brick.mask_hi) : uvec2(0u);
}

// Whether an entry has the bit of brick y.
bool isInColumn(uvec3 column, uint kind, int y)
{
    uvec2 mask = columnMask(column, kind, uint(y) >> kPartLog2);
    uint bit = uint(y) & 63u;
    return (((bit < 32u ? mask.x : mask.y) >> (bit & 31u)) & 1u) != 0u;
}

// Sets a bit of an entry. Returns false if the table is full.
bool setInColumn(uvec3 column, uint kind, uint part, uint bit)
{
    bool claimed;
    uint entry = brickFindOrInsert(columnKey(column, kind, part), claimed);
    if (entry != kNoEntry)
        setCell(entry, bit);
    return entry != kNoEntry;
}

// The lowest bit from `first` on, the highest up to `last`; or kNoBrick. first: up to 64; last: from -1.
int lowestFrom(uvec2 mask, int first)
{
    uint low = first < 32 ? mask.x & (~0u << first) : 0u;
    uint high = first < 32 ? mask.y : first < 64 ? mask.y & (~0u << (first - 32)) : 0u;
    return low != 0u ? findLSB(low) : high != 0u ? 32 + findLSB(high) : kNoBrick;
}

int highestTo(uvec2 mask, int last)
{
    uint high = last >= 32 ? mask.y & (~0u >> (63 - last)) : 0u;
    uint low = last >= 32 ? mask.x : last >= 0 ? mask.x & (~0u >> (31 - last)) : 0u;
    return high != 0u ? 32 + findMSB(high) : low != 0u ? findMSB(low) : kNoBrick;
}

int inPart(int part, int bit)
{
    return bit == kNoBrick ? kNoBrick : (part << kPartLog2) + bit;
}

// The lowest brick of a column from y on, or kNoBrick.
int brickFrom(uvec3 column, int y)
{
    int part = y >> kPartLog2;
    int found = inPart(part, lowestFrom(columnMask(column, kPartBricks, uint(part)), y & 63));
    int parts_end = (gridResolution() >> int(kBrickLog2 + kPartLog2)) + 1;
    for (int next = part + 1; found == kNoBrick && next < parts_end; next = ((next >> kPartLog2) + 1) << kPartLog2)
    {
        int group = next >> kPartLog2;
        int there = inPart(group, lowestFrom(columnMask(column, kColumnParts, uint(group)), next & 63));
        if (there != kNoBrick)
            found = inPart(there, lowestFrom(columnMask(column, kPartBricks, uint(there)), 0));
    }
    return found;
}

// The highest brick of a column up to y, or kNoBrick. y: from -1.
int brickTo(uvec3 column, int y)
{
    int part = y >> kPartLog2;
    int found = kNoBrick;
    if (y >= 0)
        found = inPart(part, highestTo(columnMask(column, kPartBricks, uint(part)), y & 63));
    for (int next = part - 1; found == kNoBrick && next >= 0; next = ((next >> kPartLog2) << kPartLog2) - 1)
    {
        int group = next >> kPartLog2;
        int there = inPart(group, highestTo(columnMask(column, kColumnParts, uint(group)), next & 63));
        if (there != kNoBrick)
            found = inPart(there, highestTo(columnMask(column, kPartBricks, uint(there)), 63));
    }
    return found;
}

#endif
