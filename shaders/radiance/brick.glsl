// SPDX-License-Identifier: MIT
// Bricks (radiance/radiance.h): sums of their samples, which are integers, so that the order of threads does not
// matter; and how much of the light that a face shows is that of the brick around it.
//
// A face's mean of n samples is off by the samples' variance s over n. The light of the brick is off by the variance t
// between its faces. So the best mean of both gives the face's own light a weight of n, and the brick's one of s / t
// (B. Efron and C. Morris, Stein's Estimation Rule and Its Competitors, 1973). Both variances are measured, for each
// brick: with the luminance l of a sample, m of the face before it, and b of the brick, the mean of (l - b)^2 is s + t,
// and that of (m - b) (l - b) is t, since the errors of m and l are independent. Where a wall stands in a brick that is
// bright on one side, t is large, and no light comes through.
#ifndef ZVO_SHADERS_RADIANCE_BRICK_GLSL
#define ZVO_SHADERS_RADIANCE_BRICK_GLSL

#include "radiance/cached_face.glsl"
#include "radiance/radiance.h"

const float kSumMost = 67108860.0; // steps of a sample, so that 64 fit: 2^26 - 4

// A step of the sums of a brick that keeps a light: between 2^-11 and 2^-12 of its strongest channel, so that samples
// of up to 16,384 times as much fit. Brighter ones count as that. Of a brick that keeps none, 2^-14.
float stepOfBrick(uvec2 light)
{
    vec3 cached = cachedRadiance(light);
    bool is_dark = cached == vec3(0.0);
    return exp2(is_dark ? -14.0 : float(exponentFor(cached, 12)));
}

// Adds the light of a sample, rounded at random: thresholds as in radiance/cached_face.glsl. counts: as in BrickSum.
void addLight(BrickSum_Ptr sums, uint index, float unit, vec3 radiance, vec3 thresholds, uint counts)
{
    precise vec3 scaled = min(radiance / unit, vec3(kSumMost));
    uvec3 light = uvec3(scaled + thresholds);
    atomicAdd(sums.data[index].light.x, light.x);
    atomicAdd(sums.data[index].light.y, light.y);
    atomicAdd(sums.data[index].light.z, light.z);
    atomicAdd(sums.data[index].counts, counts);
}

const uint kSumOfSample = 1u;
const uint kSumOfMove = 1u << 8;
const uint kSumOfSpread = 1u << 16;

// What samples tell of both: the mean of (l - b)^2, and that of (m - b) (l - b).
struct BrickSpread
{
    float total;
    float between;
};

// What a sample tells, in units of the square of what is brighter, the face or the brick. A sample of more than 16
// times that counts as 16 times, so that none decides alone.
BrickSpread spreadOf(float sampled, float face, float brick)
{
    float unit = max(max(face, brick), sampled / 16.0);
    precise float sample_apart = (sampled - brick) / unit;
    precise float face_apart = (face - brick) / unit;
    return unit > 0.0 ? BrickSpread(sample_apart * sample_apart, face_apart * sample_apart) : BrickSpread(0.0, 0.0);
}

const float kSpreadMost = 512.0; // of a sample

// Adds the spread of a sample to the sums of a brick, rounded at random by two numbers in [0, 1).
void addSpread(BrickSum_Ptr sums, uint index, BrickSpread spread, vec2 thresholds)
{
    vec2 bounded = clamp(vec2(spread.total, spread.between), -kSpreadMost, kSpreadMost);
    precise vec2 scaled = bounded * float(1u << kSpreadShift) + thresholds;
    ivec2 rounded = ivec2(floor(scaled));
    atomicAdd(sums.data[index].total, rounded.x);
    atomicAdd(sums.data[index].between, rounded.y);
}

// The spread of few samples is uncertain: that of so many of a usual brick counts, too.
const float kUsualSamples = 64.0;
const float kUsualRatio = 16.0; // s / t

// How many samples of a face the light of its brick counts as: s / t. samples: that the spread is a mean of.
float samplesOfBrick(BrickSpread spread, uint samples)
{
    float known = float(samples) / (float(samples) + kUsualSamples);
    precise float between = mix(spread.total / (kUsualRatio + 1.0), max(spread.between, 0.0), known);
    precise float within = max(spread.total - between, 0.0);
    return samples == 0u ? kUsualRatio : min(within / max(between, 1e-6), kBrickSamplesMax);
}

// The weight of the brick's light in what a face with so many samples shows.
float shareOfBrick(float samples, float brick_samples)
{
    const float kLeast = 1.0 / (1.0 + kBrickShareEnds);
    precise float share = brick_samples / max(samples + brick_samples, 1.0);
    return max(share - kLeast, 0.0) / (1.0 - kLeast);
}

// How a brick keeps its spread: FaceState::own of a brick.
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
