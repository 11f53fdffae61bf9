// SPDX-License-Identifier: MIT
// Sums of what the camera's rays see.
// Needs the constants kNodeLevels, kFormat and kSmooth, params.attributes and params.features.
#ifndef ZVO_SHADERS_PATH_FEATURE_SUM_GLSL
#define ZVO_SHADERS_PATH_FEATURE_SUM_GLSL

#include "lib/hit.glsl"
#include "lib/normal.glsl"
#include "path/path.h"
#include "path/pixel.glsl"
#include "trace/surface.glsl"

// Adds what the ray of a sample sees. direct: radiance that it has met. origin, axis: PictureCamera's.
void addFeatures(uint pixel, Ray ray, Hit hit, vec3 direct, vec3 origin, vec3 axis)
{
    PixelFeatures sum = loadFeatures(PixelFeatures_ConstPtr(uint64_t(params.features)), pixel);
    sum.direct += direct;
    if (!isMiss(hit) && hitFace(hit) != kFaceInside)
    {
        Surface surface = surfaceAt(hit, normalize(1.0 / ray.inverse_direction), params.attributes, params.attributes);
        sum.albedo += surface.albedo;
        sum.normal += kSmooth ? surface.normal : faceNormal(hitFace(hit), ray.inverse_direction);
        sum.depth += dot(ray.origin + hit.t / ray.inverse_direction - origin, axis);
        sum.hits += 1.0;
    }
    storeFeatures(params.features, pixel, sum);
}

#endif
