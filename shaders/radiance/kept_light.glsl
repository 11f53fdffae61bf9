// SPDX-License-Identifier: MIT
// The light that a face keeps: three mantissas with one exponent. Those of all samples have 16 bits, and stand beside
// the number of samples that the mean counts; those of the last samples have 8.
//
// thresholds: three numbers in [0, 1). A channel is rounded up where its fraction is above one minus that. So means of
// many small steps stay unbiased.
#ifndef ZVO_SHADERS_RADIANCE_KEPT_LIGHT_GLSL
#define ZVO_SHADERS_RADIANCE_KEPT_LIGHT_GLSL

vec3 thresholdsOf(uint random)
{
    return vec3(random & 1023u, bitfieldExtract(random, 10, 10), bitfieldExtract(random, 20, 10)) / 1024.0;
}

const int kKeptBias = 37; // a mantissa is worth 2^(exponent - kKeptBias)

vec3 keptRadiance(uvec2 light)
{
    vec3 mantissas = vec3(light.x & 0xFFFFu, light.x >> 16, light.y & 0xFFFFu);
    return mantissas * exp2(float(int(bitfieldExtract(light.y, 16, 6)) - kKeptBias));
}

uint keptWeight(uvec2 light)
{
    return light.y >> 22;
}

// The power of two that a mantissa of so many bits is worth.
int exponentFor(vec3 radiance, int bits)
{
    float strongest = max(radiance.r, max(radiance.g, radiance.b));
    return int(floatBitsToUint(strongest) >> 23) - 126 - bits;
}

uvec3 mantissasOf(vec3 radiance, int exponent, int bits, vec3 thresholds)
{
    precise vec3 scaled = radiance * exp2(float(-exponent));
    return uvec3(min(scaled + thresholds, vec3(float((1 << bits) - 1))));
}

uvec2 packKept(vec3 radiance, uint weight, vec3 thresholds)
{
    int exponent = clamp(exponentFor(radiance, 16), -kKeptBias, 63 - kKeptBias);
    uvec3 mantissas = mantissasOf(radiance, exponent, 16, thresholds);
    return uvec2(mantissas.r | (mantissas.g << 16),
                 mantissas.b | (uint(exponent + kKeptBias) << 16) | (weight << 22));
}

const int kRecentBias = 126;

vec3 recentRadiance(uint recent)
{
    return (unpackUnorm4x8(recent) * 255.0).rgb * exp2(float(int(recent >> 24) - kRecentBias));
}

uint packRecent(vec3 radiance, vec3 thresholds)
{
    int exponent = clamp(exponentFor(radiance, 8), -kRecentBias, 254 - kRecentBias);
    uvec3 mantissas = mantissasOf(radiance, exponent, 8, thresholds);
    return mantissas.r | (mantissas.g << 8) | (mantissas.b << 16) | (uint(exponent + kRecentBias) << 24);
}

#endif
