// SPDX-License-Identifier: MIT
// Keys of the brick table (shared/bricks.h).
// Needs the constant kWideKeys: the octree has more than kNarrowLevelsMax levels.
#ifndef ZVO_SHADERS_LIB_BRICK_KEYS_GLSL
#define ZVO_SHADERS_LIB_BRICK_KEYS_GLSL

#include "lib/morton.glsl"
#include "shared/bricks.h"

// The key of a cell among the 4^levels cells of its level. Narrow keys are in x, with y = 0.
uvec2 brickKey(uvec3 cell, uint levels)
{
    uint marker = 6u * levels;
    if (!kWideKeys)
        return uvec2(mortonEncode(cell) | (1u << marker), 0u);
    uvec2 leading = marker < kBrickKeyBits ? uvec2(1u << marker, 0u) : uvec2(0u, 1u << (marker - kBrickKeyBits));
    return mortonEncodeWide(cell) | leading | kBrickKeyTag;
}

// The cell of a key of that level.
uvec3 brickCell(uvec2 key, uint levels)
{
    uint marker = 6u * levels;
    if (!kWideKeys)
        return mortonDecode(key.x & ~(1u << marker));
    uvec2 leading = marker < kBrickKeyBits ? uvec2(1u << marker, 0u) : uvec2(0u, 1u << (marker - kBrickKeyBits));
    uvec2 code = key & ~(leading | kBrickKeyTag);
    return mortonDecode(code.x) | (mortonDecode(code.y) << 10);
}

uvec2 parentKey(uvec2 key)
{
    if (!kWideKeys)
        return uvec2(key.x >> 6, 0u);
    uvec2 code = key & ~kBrickKeyTag;
    return uvec2((code.x >> 6) | ((code.y << (kBrickKeyBits - 6u)) & ((1u << kBrickKeyBits) - 1u)), code.y >> 6) |
           kBrickKeyTag;
}

// The key of a child of a node, from 0 to 63.
uvec2 childKey(uvec2 key, uint child)
{
    if (!kWideKeys)
        return uvec2((key.x << 6) | child, 0u);
    uvec2 code = key & ~kBrickKeyTag;
    uint low = ((code.x << 6) & ((1u << kBrickKeyBits) - 1u)) | child;
    return uvec2(low, (code.y << 6) | (code.x >> (kBrickKeyBits - 6u))) | kBrickKeyTag;
}

bool isSameKey(uvec2 a, uvec2 b)
{
    return a.x == b.x && (!kWideKeys || a.y == b.y);
}

uvec2 keyOf(BrickEntry brick)
{
    return uvec2(brick.key, brick.base);
}

// Index of a node that octree/place has numbered.
uint nodeOf(BrickEntry brick)
{
    return kWideKeys ? brick.mask_lo : brick.base;
}

#endif
