// SPDX-License-Identifier: MIT
// Loads of the brick table (shared/bricks.h). What other threads change in the dispatch may be out of date.
// Needs params.bricks.
// BRICKS_BINDING (optional): the binding of the table in the kernel's bound form (lib/bound.glsl).
#ifndef ZVO_SHADERS_LIB_BRICK_LOADS_GLSL
#define ZVO_SHADERS_LIB_BRICK_LOADS_GLSL

#include "lib/bound.glsl"
#include "shared/bricks.h"

#if defined(BOUND) && defined(BRICKS_BINDING)

TEXELS_4(BRICKS_BINDING, bricks);

BrickEntry loadBrick(uint entry)
{
    uvec4 words = texelFetch(texels4_bricks, int(entry));
    return BrickEntry(words.x, words.y, words.z, words.w);
}

#else

BrickEntry loadBrick(uint entry)
{
    return params.bricks.data[entry];
}

#endif

#endif
