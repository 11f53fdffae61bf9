// SPDX-License-Identifier: MIT
// Masks of the 4x4x4 cells of a block, in two halves, with bits as lib/morton.glsl's cellInBlock() numbers the cells.
#ifndef ZVO_SHADERS_LIB_CELL_MASKS_GLSL
#define ZVO_SHADERS_LIB_CELL_MASKS_GLSL

// Of a half, the cells whose coordinate is 0. Each further one is as many bits, or for z = 2 a half, further on.
const uint kCellsX0 = 0x00550055u; // 1 is a bit further on, 2 a byte, 3 both
const uint kCellsY0 = 0x00003333u; // 2 bits, two bytes
const uint kCellsZ0 = 0x0F0F0F0Fu; // 4 bits, a half

// Bits that move up to change places with those behind them, for the lower bits of a cell's number.
const uint kEvenBits = 0x55555555u;
const uint kEvenPairs = 0x33333333u;
const uint kEvenFours = 0x0F0F0F0Fu;
const uint kEvenBytes = 0x00FF00FFu;

// The mask, or nothing if bit `bit` of bits is not set.
uint maskIf(uint bits, int bit, uint mask)
{
    return uint(bitfieldExtract(int(bits), bit, 1)) & mask;
}

// The cells whose coordinates are at least `from` and at most `to`, which may lie outside of the block. from: at least
// 0.
uvec2 cellsBetween(ivec3 from, ivec3 to)
{
    // A bit for each coordinate, along each axis.
    uvec3 lines = uvec3((ivec3(15) << min(from, ivec3(4))) & ((ivec3(1) << (clamp(to, ivec3(-1), ivec3(3)) + 1)) - 1));
    uint x = maskIf(lines.x, 0, kCellsX0) | maskIf(lines.x, 1, kCellsX0 << 1) | maskIf(lines.x, 2, kCellsX0 << 8) |
             maskIf(lines.x, 3, kCellsX0 << 9);
    uint y = maskIf(lines.y, 0, kCellsY0) | maskIf(lines.y, 1, kCellsY0 << 2) | maskIf(lines.y, 2, kCellsY0 << 16) |
             maskIf(lines.y, 3, kCellsY0 << 18);
    uvec2 z = uvec2(maskIf(lines.z, 0, kCellsZ0) | maskIf(lines.z, 1, kCellsZ0 << 4),
                    maskIf(lines.z, 2, kCellsZ0) | maskIf(lines.z, 3, kCellsZ0 << 4));
    return x & y & z;
}

// The cells with these bits of their numbers inverted.
uvec2 flippedCells(uvec2 cells, uint bits)
{
    cells = (bits & 1u) != 0u ? ((cells & kEvenBits) << 1) | ((cells >> 1) & kEvenBits) : cells;
    cells = (bits & 2u) != 0u ? ((cells & kEvenPairs) << 2) | ((cells >> 2) & kEvenPairs) : cells;
    cells = (bits & 4u) != 0u ? ((cells & kEvenFours) << 4) | ((cells >> 4) & kEvenFours) : cells;
    cells = (bits & 8u) != 0u ? ((cells & kEvenBytes) << 8) | ((cells >> 8) & kEvenBytes) : cells;
    cells = (bits & 16u) != 0u ? (cells << 16) | (cells >> 16) : cells;
    return (bits & 32u) != 0u ? cells.yx : cells;
}

// The cells whose numbers are at least `number`, of 0 to 64.
uvec2 cellsFrom(uint number)
{
    return uvec2(number < 32u ? ~0u << number : 0u, number <= 32u ? ~0u : number < 64u ? ~0u << (number - 32u) : 0u);
}

// The mask of one cell.
uvec2 cellBit(uint cell)
{
    return cell < 32u ? uvec2(1u << cell, 0u) : uvec2(0u, 1u << (cell & 31u));
}

// The lowest number of a cell. There must be one.
uint firstCell(uvec2 cells)
{
    return cells.x != 0u ? uint(findLSB(cells.x)) : 32u + uint(findLSB(cells.y));
}

#endif
