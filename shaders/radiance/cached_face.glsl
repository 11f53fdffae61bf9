// SPDX-License-Identifier: MIT
// What a cached face consists of (radiance/cached_faces.h): its key, and the light that it keeps.
// Needs params.faces, and params.states with STATES_BINDING.
// FACES_BINDING, STATES_BINDING (optional): the bindings of both in the kernel's bound form (lib/bound.glsl).
//
// Light is three mantissas with one exponent. Those of all samples have 16 bits, and stand beside the number of samples
// that the mean counts; those of the last samples have 8.
//
// thresholds: three numbers in [0, 1). A channel is rounded up where its fraction is above one minus that. So means of
// many small steps stay unbiased.
#ifndef ZVO_SHADERS_RADIANCE_CACHED_FACE_GLSL
#define ZVO_SHADERS_RADIANCE_CACHED_FACE_GLSL

#include "lib/bound.glsl"
#include "radiance/cached_faces.h"

// cell: of the level. normal: its number as in LightBrick::exposed.
uvec2 faceKey(uvec3 cell, uint normal, uint level)
{
    return uvec2(cell.x | ((cell.y & 511u) << 18) | kFaceKeyTag,
                 (cell.y >> 9) | (cell.z << 9) | ((normal + 1u) << 27) | (level << 30));
}

uvec3 cellOfFace(uvec2 key)
{
    return uvec3(key.x & 0x3FFFFu, bitfieldExtract(key.x, 18, 9) | ((key.y & 511u) << 9),
                 bitfieldExtract(key.y, 9, 18));
}

uint normalOfFace(uvec2 key)
{
    return bitfieldExtract(key.y, 27, 3) - 1u;
}

uint levelOfFace(uvec2 key)
{
    return key.y >> 30;
}

// Two words that the random numbers of a face depend on.
uvec2 seedsOfFace(uvec2 key)
{
    uvec3 cell = cellOfFace(key);
    return uvec2(cell.x | (cell.y << 18),
                 (cell.y >> 13) | (cell.z << 5) | (normalOfFace(key) << 23) | (levelOfFace(key) << 26)) |
           (1u << 31);
}

vec3 thresholdsOf(uint random)
{
    return vec3(random & 1023u, bitfieldExtract(random, 10, 10), bitfieldExtract(random, 20, 10)) / 1024.0;
}

const int kCacheBias = 37; // a mantissa is worth 2^(exponent - kCacheBias)

vec3 cachedRadiance(uvec2 light)
{
    vec3 mantissas = vec3(light.x & 0xFFFFu, light.x >> 16, light.y & 0xFFFFu);
    return mantissas * exp2(float(int(bitfieldExtract(light.y, 16, 6)) - kCacheBias));
}

uint cachedWeight(uvec2 light)
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

uvec2 packCached(vec3 radiance, uint weight, vec3 thresholds)
{
    int exponent = clamp(exponentFor(radiance, 16), -kCacheBias, 63 - kCacheBias);
    uvec3 mantissas = mantissasOf(radiance, exponent, 16, thresholds);
    return uvec2(mantissas.r | (mantissas.g << 16),
                 mantissas.b | (uint(exponent + kCacheBias) << 16) | (weight << 22));
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

#if defined(BOUND) && defined(FACES_BINDING)

TEXELS_4(FACES_BINDING, faces);

CachedFace loadFace(uint slot)
{
    uvec4 words = texelFetch(texels4_faces, int(slot));
    return CachedFace(words.xy, words.zw);
}

#else

CachedFace loadFace(uint slot)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(params.faces));
    return CachedFace(unpackUint2x32(words.data[2u * slot]), unpackUint2x32(words.data[2u * slot + 1u]));
}

#endif

#ifdef STATES_BINDING
#include "radiance/radiance.h"

#ifdef BOUND
TEXELS_4(STATES_BINDING, states);

FaceState loadFaceState(uint slot)
{
    uvec4 words = texelFetch(texels4_states, int(slot));
    return FaceState(words.x, words.y, words.zw);
}
#else
FaceState loadFaceState(uint slot)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(params.states));
    uvec2 first = unpackUint2x32(words.data[2u * slot]);
    return FaceState(first.x, first.y, unpackUint2x32(words.data[2u * slot + 1u]));
}
#endif
#endif

#endif
