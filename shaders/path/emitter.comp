#version 460
// SPDX-License-Identifier: MIT
// Adds the light of emissive voxels that rays have hit.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "path/face.glsl"

layout(constant_id = 0) const uint kSampling = kSampleBoth; // how light is found
layout(constant_id = 1) const uint kNodeLevels = 5u;
layout(constant_id = 2) const bool kByPower = false; // lights are chosen whatever their place

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathLightParams params;
};

#define LIGHT_NODES params.light_nodes
#define LIGHT_BRICKS params.light_bricks
#include "light/choose.glsl"
#include "path/emission.glsl"
#include "path/lists.glsl"
#include "path/state.glsl"
#include "path/weights.glsl"

// Light that the hit voxel gives off. origin: of the ray.
vec3 lightOfHit(PathState state, Hit hit, vec3 origin, vec3 direction)
{
    float density = 0.0;
    if (kSampling == kSampleBoth && hitFace(hit) != kFaceInside)
    {
        uint normal = normalOfHit(hitFace(hit), direction);
        LitPlace from = LitPlace(origin, normalAxis(state.normal));
        float cosine = abs(dot(normalAxis(normal), direction));
        float area_density = lightProbability(from, hitCell(hit), normal) * exp2(4.0 * float(kNodeLevels));
        density = state.kinds.z * area_density * hit.t * hit.t / max(cosine, 1e-20);
    }
    return emissionOf(hit.index) * chanceWeight(state, density);
}

void main()
{
    uint i = threadIndex();
    if (i >= listLength(params.bounce, kListEmitters))
        return;
    uint path = params.numbers.data[kListEmitters * params.batch + i];
    PathState state = loadState(params.states, path);
    Ray ray = loadRay(params.rays, path);
    vec3 direction = normalize(1.0 / ray.inverse_direction);
    vec3 light = lightOfHit(state, loadHit(params.hits, path), ray.origin, direction);
    params.radiance.data[state.slot] += state.throughput * light;
}
