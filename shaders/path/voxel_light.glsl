// SPDX-License-Identifier: MIT
// Light of voxels: what a ray meets, and what is chosen.
// Needs the constants kNodeLevels, kByPower, kSampling and kSmooth, params.light_nodes, params.light_bricks,
// params.sample_index and params.tree.
#ifndef ZVO_SHADERS_PATH_VOXEL_LIGHT_GLSL
#define ZVO_SHADERS_PATH_VOXEL_LIGHT_GLSL

#include "lib/emission.glsl"
#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "lib/sampling.glsl"
#include "light/choose.glsl"
#include "light/importance.glsl"
#include "path/chosen_light.glsl"
#include "path/normal.glsl"
#include "path/path.h"
#include "path/state.glsl"

// What a ray that has hit an emissive voxel brings to the pixel.
vec3 lightOfHit(PathState state, Ray ray, Hit hit)
{
    vec3 direction = normalize(1.0 / ray.inverse_direction);
    float density = 0.0;
    if (kSampling == kSampleBoth && hitFace(hit) != kFaceInside)
    {
        uint normal = normalOfHit(hitFace(hit), direction);
        LitPlace from = LitPlace(ray.origin, normalOf(state.normal));
        float cosine = abs(dot(normalAxis(normal), direction));
        float probability =
            lightProbability(params.light_nodes, params.light_bricks, from, hitCell(hit), normal);
        float area_density = probability * exp2(4.0 * float(kNodeLevels));
        density = state.kinds.z * area_density * hit.t * hit.t / max(cosine, 1e-20);
    }
    return state.throughput * (emissionOf(params.tree, hit.index) * chanceWeight(state, density));
}

// A point of a face of an emissive voxel, for a path that leaves a face at origin.
ChosenDirection chooseVoxelLight(PathState state, vec3 origin, uint bounce)
{
    uint pair = bounce * kPathPairs;
    vec2 point = samplePair(params.sample_index, state.seed, pair + kPairPoint);
    ChosenLight light = chooseLight(params.light_nodes, params.light_bricks, LitPlace(origin, normalOf(state.normal)),
                                    samplePair(params.sample_index, state.seed, pair + kPairChoice));
    float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 way = pointOfFace(light.cell, light.face, edge, point) - origin;
    float square = max(dot(way, way), 1e-30);
    ChosenDirection chosen;
    chosen.direction = way / sqrt(square);
    chosen.target = unpackUint2x32(packHitCell(light.cell, kNodeLevels, light.face % 3u));
    float cosine = -dot(normalAxis(light.face), chosen.direction);
    chosen.density = 0.0;
    chosen.light = vec3(0.0);
    if (cosine > 0.0 && light.probability > 0.0)
    {
        chosen.density = state.kinds.z * light.probability / (edge * edge) * square / cosine;
        chosen.light = emissionOf(params.tree, light.voxel);
    }
    return chosen;
}

#endif
