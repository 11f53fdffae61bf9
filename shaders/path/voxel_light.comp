#version 460
// SPDX-License-Identifier: MIT
// Chooses a point of an emissive voxel for each path of a list, and lists a shadow ray.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ray.glsl"
#include "lib/sobol.glsl"
#include "path/face.glsl"
#include "path/numbers.glsl"

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
#include "path/shadow.glsl"

// A point of a face of a voxel with this edge, by two numbers in [0, 1).
vec3 pointOfFace(uvec3 cell, uint normal, float edge, vec2 u)
{
    vec3 across = normal % 3u == 0u ? vec3(0.0, u) : normal % 3u == 1u ? vec3(u.x, 0.0, u.y) : vec3(u, 0.0);
    return 1.0 + edge * (vec3(cell) + max(normalAxis(normal), 0.0) + across);
}

void main()
{
    uint i = threadIndex();
    uint length = listLength(params.bounce, kListVoxelLights);
    bool exists = i < length;
    uint path = params.numbers.data[kListVoxelLights * params.batch + min(i, length - 1u)];
    PathState state = loadState(params.states, path);
    vec3 origin = loadRay(params.rays, path).origin;
    vec3 normal = normalAxis(state.normal);
    uint pair = params.bounce * kPathPairs;
    vec2 point = samplePair(params.sample_index, state.seed, pair + kPairPoint);
    ChosenLight light = chooseLight(LitPlace(origin, normal),
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
        chosen.light = emissionOf(light.voxel);
    }
    appendShadow(exists, origin, state, normal, chosen);
}
