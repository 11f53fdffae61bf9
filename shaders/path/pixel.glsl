// SPDX-License-Identifier: MIT
// What is kept of a pixel (path/path.h): its number, the sums of its samples, and its features. They move as 64-bit
// words, as rays do, where a whole one is loaded or stored.
#ifndef ZVO_SHADERS_PATH_PIXEL_GLSL
#define ZVO_SHADERS_PATH_PIXEL_GLSL

#include "lib/color.glsl"
#include "path/path.h"

uvec2 pixelOfNumber(uint number, uvec2 size)
{
    uint strip = number / (kStripRows * size.x);
    uint rest = number - strip * kStripRows * size.x;
    uint rows = min(kStripRows, size.y - strip * kStripRows);
    return uvec2(rest / rows, strip * kStripRows + rest % rows);
}

uint numberOfPixel(uvec2 pixel, uvec2 size)
{
    uint strip = pixel.y / kStripRows;
    uint rows = min(kStripRows, size.y - strip * kStripRows);
    return strip * kStripRows * size.x + pixel.x * rows + pixel.y % kStripRows;
}

// Adds a sample of a pixel, of which no other thread has one at the same time.
void addSample(PixelSum_Ptr sums, uint pixel, vec3 radiance)
{
    float light = luminance(radiance);
    PixelSum sum = sums.data[pixel];
    sums.data[pixel] = PixelSum(sum.radiance + radiance, sum.luminance_squared + light * light);
}

// Adds the light of a sample that the camera does not see directly. direct: luminance of what it does.
void addScattered(PixelFeatures_Ptr features, uint pixel, vec3 radiance, float direct)
{
    float scattered = luminance(radiance) - direct;
    features.data[pixel].scattered_squared += scattered * scattered;
}

void setRadiance(PixelSum_Ptr sums, uint pixel, vec3 radiance)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(sums));
    words.data[2u * pixel] = packUint2x32(floatBitsToUint(radiance.rg));
    words.data[2u * pixel + 1u] = uint64_t(floatBitsToUint(radiance.b));
}

// Adds radiance to a pixel, of which no other thread has any at the same time. In words of 64 bits: lavapipe pays per
// word.
void addRadiance(PixelSum_Ptr sums, uint pixel, vec3 radiance)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(sums));
    vec2 red_green = uintBitsToFloat(unpackUint2x32(words.data[2u * pixel]));
    vec2 blue = uintBitsToFloat(unpackUint2x32(words.data[2u * pixel + 1u]));
    words.data[2u * pixel] = packUint2x32(floatBitsToUint(red_green + radiance.rg));
    words.data[2u * pixel + 1u] = packUint2x32(floatBitsToUint(vec2(blue.x + radiance.b, blue.y)));
}

PixelFeatures loadFeatures(PixelFeatures_ConstPtr features, uint i)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(features));
    vec2 a = uintBitsToFloat(unpackUint2x32(words.data[6u * i]));
    vec2 b = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 1u]));
    vec2 c = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 2u]));
    vec2 d = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 3u]));
    vec2 e = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 4u]));
    vec2 f = uintBitsToFloat(unpackUint2x32(words.data[6u * i + 5u]));
    return PixelFeatures(vec3(a, b.x), b.y, vec3(c, d.x), d.y, vec3(e, f.x), f.y);
}

void storeFeatures(PixelFeatures_Ptr features, uint i, PixelFeatures sum)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(features));
    words.data[6u * i] = packUint2x32(floatBitsToUint(sum.albedo.xy));
    words.data[6u * i + 1u] = packUint2x32(floatBitsToUint(vec2(sum.albedo.z, sum.depth)));
    words.data[6u * i + 2u] = packUint2x32(floatBitsToUint(sum.normal.xy));
    words.data[6u * i + 3u] = packUint2x32(floatBitsToUint(vec2(sum.normal.z, sum.hits)));
    words.data[6u * i + 4u] = packUint2x32(floatBitsToUint(sum.direct.xy));
    words.data[6u * i + 5u] = packUint2x32(floatBitsToUint(vec2(sum.direct.z, sum.scattered_squared)));
}

#endif
