#version 460
// SPDX-License-Identifier: MIT
// Chooses the exposure that makes the mean brightness, in stops, that of middle grey. The darkest and the brightest
// pixels do not count, and neither do those without light.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathExposeParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#define SCAN_GROUP kPathGroup
#include "lib/scan.glsl"

const uint kBins = kMeterBins / kPathGroup; // of a thread
const float kDarkPart = 0.1;                // of the pixels
const float kBrightPart = 0.05;
const float kMiddleGrey = 0.2; // radiance that the tone map shows as one

shared vec2 s_sums[kPathGroup];

void main()
{
    uint i = gl_LocalInvocationIndex;
    uint own = 0u;
    for (uint k = 0u; k < kBins; ++k)
        own += i + k == 0u ? 0u : params.counts.data[i * kBins + k]; // bin 0 is without light
    uint total;
    uint before = workgroupExclusiveAdd(own, total);
    float low = kDarkPart * float(total);
    float high = (1.0 - kBrightPart) * float(total);
    vec2 sum = vec2(0.0); // of pixels, and of their stops
    for (uint k = 0u; k < kBins; ++k)
    {
        uint bin = i * kBins + k;
        uint count = bin == 0u ? 0u : params.counts.data[bin];
        float counted = max(min(float(before + count), high) - max(float(before), low), 0.0);
        sum += counted * vec2(1.0, (float(bin) + 0.5) * (kMeterStops / float(kMeterBins)) + kMeterDarkest);
        before += count;
    }
    s_sums[i] = sum;
    for (uint distance = kPathGroup / 2u; distance != 0u; distance /= 2u)
    {
        barrier();
        if (i < distance)
            s_sums[i] += s_sums[i + distance];
    }
    if (i == 0u)
        params.exposure.data[0] = params.factor * (s_sums[0].x > 0.0 ? kMiddleGrey / exp2(s_sums[0].y / s_sums[0].x) : 1.0);
}
