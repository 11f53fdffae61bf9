// SPDX-License-Identifier: MIT
// Light of voxels that rays have hit. The includer includes path/path.h, lib/hit.glsl, light/choose.glsl,
// path/emission.glsl, path/face.glsl and path/weights.glsl before and declares kSampling.
#ifndef ZVO_SHADERS_PATH_EMITTER_GLSL
#define ZVO_SHADERS_PATH_EMITTER_GLSL

#include "lib/emission.glsl"
#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "light/choose.glsl"
#include "light/importance.glsl"
#include "path/path.h"
#include "path/weights.glsl"

// What a ray that has hit an emissive voxel brings to the pixel.
vec3 lightOfHit(PathState state, Ray ray, Hit hit)
{
    vec3 direction = normalize(1.0 / ray.inverse_direction);
    float density = 0.0;
    if (kSampling == kSampleBoth && hitFace(hit) != kFaceInside)
    {
        uint normal = normalOfHit(hitFace(hit), direction);
        LitPlace from = LitPlace(ray.origin, normalAxis(state.normal));
        float cosine = abs(dot(normalAxis(normal), direction));
        float area_density = lightProbability(from, hitCell(hit), normal) * exp2(4.0 * float(kNodeLevels));
        density = state.kinds.z * area_density * hit.t * hit.t / max(cosine, 1e-20);
    }
    return state.throughput * (emissionOf(params.tree, hit.index) * chanceWeight(state, density));
}

#endif
