// SPDX-License-Identifier: MIT
// How much of the light that a face shows is that of the brick around it. The includer includes radiance/radiance.h
// before.
//
// A face's mean of n samples is off by the samples' variance s over n. The light of the brick is off by the variance t
// between its faces. So the best mean of both gives the face's own light a weight of n, and the brick's one of s / t
// (B. Efron and C. Morris, Stein's Estimation Rule and Its Competitors, 1973). Both variances are measured, for each
// brick: with the luminance l of a sample, m of the face before it, and b of the brick, the mean of (l - b)^2 is s + t,
// and that of (m - b) (l - b) is t, since the errors of m and l are independent. Where a wall stands in a brick that is
// bright on one side, t is large, and no light comes through.

// What a sample tells of both: FaceSpread.
struct FaceSpread
{
    float apart;   // (l - b)^2
    float between; // (m - b) (l - b)
};

// In units of the square of what is brighter, the face or the brick. A sample of more than 16 times that counts as 16
// times, so that none decides alone.
FaceSpread spreadOf(float sampled, float face, float brick)
{
    float unit = max(max(face, brick), sampled / 16.0);
    precise float apart = (sampled - brick) / unit;
    precise float between = (face - brick) / unit;
    return unit > 0.0 ? FaceSpread(apart * apart, between * apart) : FaceSpread(0.0, 0.0);
}

// Adds the spread of a sample to the sums of a brick, rounded at random by two numbers in [0, 1).
void addSpread(uint index, FaceSpread spread, vec2 thresholds)
{
    vec2 bounded = clamp(vec2(spread.apart, spread.between), -kSpreadMost, kSpreadMost);
    precise vec2 scaled = bounded * float(1u << kSpreadShift) + thresholds;
    ivec2 rounded = ivec2(floor(scaled));
    atomicAdd(params.sums.data[index].apart, rounded.x);
    atomicAdd(params.sums.data[index].between, rounded.y);
}

// The spread of few samples is uncertain: that of so many of a usual brick counts, too.
const float kUsualSamples = 64.0;
const float kUsualWorth = 16.0;

// The number of a face's own samples that the brick's light is worth. words: FaceState::own of a brick.
float worthOfBrick(uvec2 words)
{
    vec2 spread = unpackHalf2x16(words.x);
    float known = float(words.y) / (float(words.y) + kUsualSamples);
    precise float between = mix(spread.x / (kUsualWorth + 1.0), max(spread.y, 0.0), known);
    precise float within = max(spread.x - between, 0.0);
    return words.y == 0u ? kUsualWorth : min(within / max(between, 1e-6), kBrickWorth);
}

// The weight of the brick's light in what a face with so many samples shows.
float shareOfBrick(float samples, float worth)
{
    const float kLeast = 1.0 / (1.0 + kBrickGone);
    precise float share = worth / max(samples + worth, 1.0);
    return max(share - kLeast, 0.0) / (1.0 - kLeast);
}
