#version 460
// SPDX-License-Identifier: MIT
// Adds what the camera's rays see to the features of each pixel of a batch.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathFeaturesParams, PATH_FEATURES_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "path/feature_sum.glsl"

void main()
{
    uint slot = threadIndex();
    if (slot >= params.pixel_count)
        return;
    vec3 direct = params.radiance.data[slot];
    params.direct.data[slot] = luminance(direct);
    addFeatures(params.first_pixel + slot, loadRay(params.rays, slot), loadHit(params.hits, slot), direct,
                params.origin, params.axis);
}
