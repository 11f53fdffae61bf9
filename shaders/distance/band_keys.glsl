// SPDX-License-Identifier: MIT
// The entries of the band's bricks in the brick table, beside those of the voxelization and of its columns.
// Needs what voxelize/fill_columns.glsl needs.
#ifndef ZVO_SHADERS_DISTANCE_BAND_KEYS_GLSL
#define ZVO_SHADERS_DISTANCE_BAND_KEYS_GLSL

#include "voxelize/fill_columns.glsl"

const uint kBandKind = 3u; // after the kinds of columns' entries

// The key of a brick of the grid.
uvec2 bandKey(uvec3 brick)
{
    return columnKey(brick.xz, kBandKind, brick.y);
}

bool isBandKey(uvec2 key)
{
    return kWideKeys ? (key.y & (kWideColumnTag | (3u << 16))) == (kWideColumnTag | (kBandKind << 16))
                     : (key.x & (kColumnTag | (3u << 28))) == (kColumnTag | (kBandKind << 28));
}

uvec3 brickOfBandKey(uvec2 key)
{
    const uint narrow = (1u << kNarrowColumnBits) - 1u;
    const uint wide = (1u << kWideColumnBits) - 1u;
    return kWideKeys ? uvec3(key.x & wide, key.y & wide, (key.x >> kWideColumnBits) & wide)
                     : uvec3(key.x & narrow, (key.x >> 16) & narrow, (key.x >> kNarrowColumnBits) & narrow);
}

#endif
