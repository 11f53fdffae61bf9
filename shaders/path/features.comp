#version 460
// SPDX-License-Identifier: MIT
// Adds what the camera's rays see to the features of each pixel of a batch.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/attribute_formats.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/luminance.glsl"
#include "lib/ray_words.glsl"
#include "lib/surface_normal.glsl"
#include "path/features.glsl"

layout(constant_id = 0) const uint kNodeLevels = 5u;
layout(constant_id = 1) const uint kFormat = kFormat8; // of attributes

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathFeaturesParams params;
};

#include "trace/surface.glsl"

void main()
{
    uint slot = threadIndex();
    if (slot >= params.pixel_count)
        return;
    Hit hit = loadHit(params.hits, slot);
    Ray ray = loadRay(params.rays, slot);
    vec3 direct = params.radiance.data[slot];
    PixelFeatures sum = loadFeatures(PixelFeatures_ConstPtr(uint64_t(params.features)), params.first_pixel + slot);
    sum.direct += direct;
    params.direct.data[slot] = luminance(direct);
    if (!isMiss(hit) && hitFace(hit) != kFaceInside)
    {
        sum.albedo += surfaceAt(hit, ray.inverse_direction, params.attributes, params.attributes).albedo;
        sum.normal += faceNormal(hitFace(hit), ray.inverse_direction);
        sum.depth += dot(ray.origin + hit.t / ray.inverse_direction - params.origin, params.forward);
        sum.hits += 1.0;
    }
    storeFeatures(params.features, params.first_pixel + slot, sum);
}
