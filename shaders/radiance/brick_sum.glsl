// SPDX-License-Identifier: MIT
// Sums of bricks (radiance.h): integers, so that the order of threads does not matter. The includer includes
// radiance/radiance.h and radiance/kept_light.glsl before, and declares params.sums.
#ifndef ZVO_SHADERS_RADIANCE_BRICK_SUM_GLSL
#define ZVO_SHADERS_RADIANCE_BRICK_SUM_GLSL

#include "radiance/kept_light.glsl"

const float kSumMost = 67108860.0; // steps of a sample, so that 64 fit: 2^26 - 4

// A step of the sums of a brick that keeps a light: between 2^-11 and 2^-12 of its strongest channel, so that samples
// of up to 16,384 times as much fit. Brighter ones count as that. Of a brick that keeps none, 2^-14.
float stepOfBrick(uvec2 light)
{
    vec3 kept = keptRadiance(light);
    bool is_dark = kept == vec3(0.0);
    return exp2(is_dark ? -14.0 : float(exponentFor(kept, 12)));
}

// Adds the light of a sample, rounded at random: thresholds as in radiance/kept_light.glsl. counts: as in BrickSum.
void addLight(uint index, float unit, vec3 radiance, vec3 thresholds, uint counts)
{
    precise vec3 scaled = min(radiance / unit, vec3(kSumMost));
    uvec3 light = uvec3(scaled + thresholds);
    atomicAdd(params.sums.data[index].light.x, light.x);
    atomicAdd(params.sums.data[index].light.y, light.y);
    atomicAdd(params.sums.data[index].light.z, light.z);
    atomicAdd(params.sums.data[index].counts, counts);
}

const uint kSumOfSample = 1u;
const uint kSumOfMove = 1u << 8;
const uint kSumOfSpread = 1u << 16;

#endif
