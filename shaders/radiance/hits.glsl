// SPDX-License-Identifier: MIT
// Hits of rays, and of the camera's pixels.
// Needs params.hits.
// HITS_BINDING (optional): the binding of them in the kernel's bound form (lib/bound.glsl).
#ifndef ZVO_SHADERS_RADIANCE_HITS_GLSL
#define ZVO_SHADERS_RADIANCE_HITS_GLSL

#include "lib/bound.glsl"
#include "lib/hit.glsl"
#include "trace/trace.h"

#if defined(BOUND) && defined(HITS_BINDING)

TEXELS_4(HITS_BINDING, hits);

Hit hitAt(uint i)
{
    uvec4 words = texelFetch(texels4_hits, int(i));
    return Hit(uintBitsToFloat(words.x), words.y, words.zw);
}

#else

Hit hitAt(uint i)
{
    return loadHit(params.hits, i);
}

#endif

// The hit of a pixel of a picture of this width; those of dead tiles are misses. starts: of tiles.
Hit seenHit(float_ConstPtr starts, uint width, uvec2 pixel)
{
    uvec2 tile = pixel / kTileEdge;
    uint tiles_x = (width + kTileEdge - 1u) / kTileEdge;
    bool live = starts.data[tile.y * tiles_x + tile.x] != kTileDead;
    Hit hit = hitAt(pixel.y * width + pixel.x);
    hit.index = live ? hit.index : kHitMiss;
    return hit;
}

#endif
