#version 460
// SPDX-License-Identifier: MIT
// Counts the pixels of each brightness, for the automatic exposure.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathMeterParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/color.glsl"
#include "lib/dispatch.glsl"

shared uint s_counts[kMeterBins];

void main()
{
    for (uint bin = gl_LocalInvocationIndex; bin < kMeterBins; bin += kPathGroup)
        s_counts[bin] = 0u;
    barrier();
    uint first = workgroupIndex() * kMeterPixels;
    for (uint k = gl_LocalInvocationIndex; k < kMeterPixels; k += kPathGroup)
    {
        if (first + k < params.pixel_count)
        {
            float light = params.sample_part * luminance(params.sums.data[first + k].radiance);
            float stops = clamp(log2(max(light, exp2(kMeterDarkest))) - kMeterDarkest, 0.0, kMeterStops);
            uint bin = min(uint(stops * (float(kMeterBins) / kMeterStops)), kMeterBins - 1u);
            atomicAdd(s_counts[light > 0.0 ? bin : 0u], 1u);
        }
    }
    barrier();
    for (uint bin = gl_LocalInvocationIndex; bin < kMeterBins; bin += kPathGroup)
        if (s_counts[bin] != 0u)
            atomicAdd(params.counts.data[bin], s_counts[bin]);
}
