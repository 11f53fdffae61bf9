// SPDX-License-Identifier: MIT
// Loads of params.hits. The includer includes lib/hit.glsl and lib/bound.glsl before, declares params, and defines
//   HITS_BINDING    the binding for them in the kernel's bound form
#ifndef ZVO_SHADERS_RADIANCE_HIT_LOADS_GLSL
#define ZVO_SHADERS_RADIANCE_HIT_LOADS_GLSL

#include "lib/bound.glsl"
#include "lib/hit.glsl"
#include "shared/trace.h"

#ifdef BOUND

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

#endif
