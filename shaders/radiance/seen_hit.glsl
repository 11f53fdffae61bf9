// SPDX-License-Identifier: MIT
// Hits of the camera's rays. The includer includes radiance/radiance.h and radiance/hit_loads.glsl before; params has
// starts, width and height, too.
#ifndef ZVO_SHADERS_RADIANCE_SEEN_HIT_GLSL
#define ZVO_SHADERS_RADIANCE_SEEN_HIT_GLSL

#include "radiance/hit_loads.glsl"
#include "trace/trace.h"

// The hit of a pixel; those of dead tiles are misses.
Hit seenHit(uvec2 pixel)
{
    uvec2 tile = pixel / kTileEdge;
    uint tiles_x = (params.width + kTileEdge - 1u) / kTileEdge;
    bool live = params.starts.data[tile.y * tiles_x + tile.x] != kTileDead;
    Hit hit = hitAt(pixel.y * params.width + pixel.x);
    hit.index = live ? hit.index : kHitMiss;
    return hit;
}

#endif
