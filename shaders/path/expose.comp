#version 460
// SPDX-License-Identifier: MIT
// Chooses the exposure of a picture from the numbers of its pixels by brightness. Pixels without light do not count.
//
// The mean, in stops and without the darkest and the brightest pixels, becomes a grey: middle grey in a picture as
// bright as the day, darker at night, as eyes see it (G. Krawczyk, K. Myszkowski, H.-P. Seidel, Perceptual Effects in
// Real-time Tone Mapping, 2005). From there the exposure goes at most kBrighterStops towards 1, which shows the default
// sky and sun as primary rays show them: a model before a bright sky stays bright. Then it goes down at most
// kDarkerStops, until the highlights keep their colour: a lamp that fills a part of the picture does not hide the rest.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathExposeParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#define SCAN_GROUP kPathGroup
#include "lib/scan.glsl"

const uint kBins = kMeterBins / kPathGroup; // of a thread
const float kDarkPart = 0.1;                // of the pixels
const float kBrightPart = 0.05;
const float kHighlightPart = 0.02; // brighter ones are lamps
const float kMiddleGrey = 0.2;     // exposed radiance that the tone map shows as one
const float kDay = 0.2;            // mean radiance by the default sky and sun
const float kUnit = 400.0;         // cd/m^2 that radiance 1 counts for: scenes' lamps are made beside a sky of 1
const float kBrighterStops = 1.5;
const float kDarkerStops = 2.0;
const float kHighlight = 3.0; // exposed radiance that the tone map shows close to white, with its colour

shared vec2 s_sums[kPathGroup];
shared float s_highlight; // radiance

// The key value of a picture with this mean, by Krawczyk et al.
float keyOf(float mean)
{
    return 1.03 - 2.0 / (2.0 + log2(kUnit * mean + 1.0) / log2(10.0));
}

float stopsOf(uint bin)
{
    return (float(bin) + 0.5) * (kMeterStops / float(kMeterBins)) + kMeterDarkest;
}

float exposureFor(float mean, float highlight)
{
    float by_mean = kMiddleGrey * keyOf(mean) / keyOf(kDay) / mean;
    float brighter = max(by_mean, min(1.0, by_mean * exp2(kBrighterStops)));
    return min(brighter, max(kHighlight / highlight, by_mean * exp2(-kDarkerStops)));
}

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
        sum += counted * vec2(1.0, stopsOf(bin));
        float brightest = (1.0 - kHighlightPart) * float(total);
        if (float(before) <= brightest && brightest < float(before + count))
            s_highlight = exp2(stopsOf(bin));
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
        params.exposure.data[0] =
            params.factor * (total != 0u ? exposureFor(exp2(s_sums[0].y / s_sums[0].x), s_highlight) : 1.0);
}
