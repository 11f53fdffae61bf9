// SPDX-License-Identifier: MIT
// How a brick keeps its spread (radiance/share_of_brick.glsl): FaceState::own of a brick. The includer includes
// radiance/share_of_brick.glsl before.
#ifndef ZVO_SHADERS_RADIANCE_BRICK_SPREAD_GLSL
#define ZVO_SHADERS_RADIANCE_BRICK_SPREAD_GLSL

#include "radiance/share_of_brick.glsl"

// The total as a float; the other number as one without its last 10 bits, where the number of samples is.
BrickSpread spreadIn(uvec2 words, out uint samples)
{
    samples = words.y & 1023u;
    return BrickSpread(uintBitsToFloat(words.x), uintBitsToFloat(words.y & ~1023u));
}

// random: 10 bits, by which the second number is rounded.
uvec2 packSpread(BrickSpread spread, uint samples, uint random)
{
    return uvec2(floatBitsToUint(spread.total), ((floatBitsToUint(spread.between) + random) & ~1023u) | samples);
}

#endif
