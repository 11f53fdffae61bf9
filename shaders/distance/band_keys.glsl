// SPDX-License-Identifier: MIT
// The entries of the band's bricks in the brick table, beside those of the voxelization and of its columns.
// Needs what voxelize/fill_columns.glsl needs.
#ifndef ZVO_SHADERS_DISTANCE_BAND_KEYS_GLSL
#define ZVO_SHADERS_DISTANCE_BAND_KEYS_GLSL

#include "voxelize/fill_columns.glsl"

const uint kBandLine = 3u; // after the numbers of lines

// The key of a brick of the grid.
uvec2 bandKey(uvec3 brick)
{
    return columnKey(uvec3(brick.xz, kBandLine), kPartBricks, brick.y);
}

bool isBandKey(uvec2 key)
{
    const uint lines = kBandLine << kColumnLineShift;
    return kWideKeys ? (key.y & (kWideColumnTag | lines)) == (kWideColumnTag | lines)
                     : (key.x & (kColumnTag | lines)) == (kColumnTag | lines);
}

uvec3 brickOfBandKey(uvec2 key)
{
    const uint narrow = (1u << kNarrowColumnBits) - 1u;
    const uint wide = (1u << kWideColumnBits) - 1u;
    return kWideKeys ? uvec3(key.x & wide, key.y & wide, (key.x >> kWideColumnBits) & wide)
                     : uvec3(key.x & narrow, (key.x >> 16) & narrow, (key.x >> kNarrowColumnBits) & narrow);
}

#endif
