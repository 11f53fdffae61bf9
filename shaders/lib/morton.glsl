// SPDX-License-Identifier: MIT
// Morton codes: x in bit 0, y in bit 1, z in bit 2 of every three.
#ifndef ZVO_SHADERS_LIB_MORTON_GLSL
#define ZVO_SHADERS_LIB_MORTON_GLSL

// Spreads the lower 10 bits of v to every third bit (30 bits).
uint spreadBits3(uint v)
{
    v = (v | (v << 16)) & 0x030000FFu;
    v = (v | (v << 8)) & 0x0300F00Fu;
    v = (v | (v << 4)) & 0x030C30C3u;
    v = (v | (v << 2)) & 0x09249249u;
    return v;
}

// Gathers every third bit of v (from bit 0) into the lower 10 bits.
uint gatherBits3(uint v)
{
    v &= 0x09249249u;
    v = (v | (v >> 2)) & 0x030C30C3u;
    v = (v | (v >> 4)) & 0x0300F00Fu;
    v = (v | (v >> 8)) & 0x030000FFu;
    v = (v | (v >> 16)) & 0x000003FFu;
    return v;
}

// Morton code of a cell whose coordinates have at most 10 bits.
uint mortonEncode(uvec3 cell)
{
    return spreadBits3(cell.x) | (spreadBits3(cell.y) << 1) | (spreadBits3(cell.z) << 2);
}

// Morton code of a cell whose coordinates have at most 20 bits: the lower 30 bits of the code, and the upper 30.
uvec2 mortonEncodeWide(uvec3 cell)
{
    return uvec2(mortonEncode(cell), mortonEncode(cell >> 10));
}

// Cell of a Morton code of at most 30 bits.
uvec3 mortonDecode(uint code)
{
    return uvec3(gatherBits3(code), gatherBits3(code >> 1), gatherBits3(code >> 2));
}

// Number of a cell inside its 4x4x4 block: the 6-bit Morton code of the coordinates modulo 4.
uint cellInBlock(uvec3 cell)
{
    uvec3 low = cell & 1u;
    uvec3 high = (cell >> 1) & 1u;
    return low.x | (low.y << 1) | (low.z << 2) | (high.x << 3) | (high.y << 4) | (high.z << 5);
}

// Coordinates inside its block of the cell with a number.
uvec3 cellNumbered(uint number)
{
    uvec3 bits = uvec3(number, number >> 1, number >> 2);
    return (bits & 1u) | ((bits >> 2) & 2u);
}

#endif
