#version 460
// SPDX-License-Identifier: MIT
// Starts a path from a random point of each face that the frame samples.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceBeginParams, RADIANCE_BEGIN_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/face.glsl"
#include "lib/ray.glsl"
#include "lib/sampling.glsl"
#include "path/state.glsl"

const bool kSmooth = false; // light goes from face to face

#define FACES_BINDING 0
#include "path/lists.glsl"
#include "path/next_ray.glsl"
#include "radiance/cached_face.glsl"

void main()
{
    uint path = threadIndex();
    uint count = listLength(0u, kListPaths);
    bool exists = path < count;
    uvec2 key = loadFace(params.numbers.data[min(path, count - 1u)]).key; // of kListPaths, the first list

    NextRay next;
    next.exists = exists;
    uvec2 seeds = seedsOfFace(key);
    uint seed = hashPair(hashPair(seeds.x, seeds.y), params.seed);
    next.state = PathState(vec3(1.0), path, seed, normalOfFace(key), 0.0, vec3(0.0));
    next.choice = samplePair(params.sample_index, seed, kPairOther).x;
    uvec3 cell = cellOfFace(key);
    uint face_normal = next.state.normal;
    vec3 normal = normalAxis(face_normal);
    float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 point = pointOfFace(cell, next.state.normal, edge, samplePair(params.sample_index, seed, kPairPixel));
    leaveFace(pointOnFace(point, cell, normal), 0u, next);
    if (exists)
    {
        storeRay(params.rays, path, next.ray);
        storeState(params.path_states, path, next.state);
        params.radiance.data[path] = vec3(0.0);
    }

    listChosen(params.numbers, params.batch, next, path, 0u);
}
