#version 460
// SPDX-License-Identifier: MIT
// Takes each path of a list on by one bounce: where its ray has hit a voxel, the next ray starts. What has to be done
// for some paths alone is listed.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"
#include "lib/attribute_formats.glsl"
#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/frame.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ray.glsl"
#include "lib/sobol.glsl"
#include "lib/surface_normal.glsl"
#include "path/face.glsl"
#include "path/numbers.glsl"
#include "path/state.glsl"

layout(constant_id = 0) const uint kNodeLevels = 5u;
layout(constant_id = 1) const uint kFormat = kFormat8;      // of attributes
layout(constant_id = 2) const bool kEmission = false;       // there are emissive voxels
layout(constant_id = 3) const uint kSampling = kSampleBoth; // how light is found
layout(constant_id = 4) const bool kLast = false;           // paths end here
layout(constant_id = 5) const bool kRoulette = false;

layout(local_size_x = kPathGroup) in;
layout(push_constant, scalar) uniform Push
{
    PathShadeParams params;
};

const bool kByPower = false;
#define LIGHT_NODES params.light_nodes
#include "light/importance.glsl"
#include "path/lists.glsl"
#include "trace/surface.glsl"

const float kPi = 3.14159265358979;
const float kRouletteMax = 0.95; // probability to go on
const uint kRouletteFirst = 3u;  // bounce

// The point of a hit: on its face exactly, and inside of the face's edges.
vec3 pointOfHit(Hit hit, Ray ray, vec3 normal)
{
    float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 low = 1.0 + edge * vec3(hitCell(hit));
    vec3 high = low + edge;
    vec3 inner_low = uintBitsToFloat(floatBitsToUint(low) + 1u);
    vec3 inner_high = uintBitsToFloat(floatBitsToUint(high) - 1u);
    vec3 point = clamp(ray.origin + hit.t / ray.inverse_direction, inner_low, inner_high);
    return mix(mix(point, high, greaterThan(normal, vec3(0.0))), low, lessThan(normal, vec3(0.0)));
}

// How probable it is that light is looked for in the map, the sun and voxels, at a place: half of it in the same way
// for all that may give any, half in proportion to how much it may give.
vec3 kindsAt(LitPlace place, uint normal)
{
    vec3 gives = vec3(uintBitsToFloat(unpackUint2x32(uint64_t_ConstPtr(uint64_t(params.gives)).data[normal])), 0.0);
    if (kEmission)
        gives.z = lightImportance(place, 0u) * exp2(-4.0 * float(kNodeLevels));
    vec3 present = vec3(gives.x > 0.0 ? 1.0 : 0.0, gives.y > 0.0 ? 1.0 : 0.0, gives.z > 0.0 ? 1.0 : 0.0);
    float count = present.x + present.y + present.z;
    return count == 0.0 ? vec3(0.0) : 0.5 * present / count + 0.5 * gives / (gives.x + gives.y + gives.z);
}

void main()
{
    uint i = threadIndex();
    uint count = listLength(params.bounce, kListPaths);
    bool exists = i < count;
    i = min(i, count - 1u);
    PathState state = loadState(params.states, i);
    Ray ray = loadRay(params.rays, i);
    Hit hit = loadHit(params.hits, i);
    bool hits = exists && !isMiss(hit);
    Attribute stored = Attribute(0u, 0u);
    if (kFormat != kFormatNone && hits)
        stored = readAttribute(kFormat, true, params.attributes, params.attributes, hit.index);

    uint miss = appendTo(params.bounce, kListMisses, exists && !hits);
    if (exists && !hits)
        params.numbers.data[kListMisses * params.batch + miss] = i;
    if (kEmission)
    {
        bool emits = hits && ((params.emission_words.data[hits ? hit.index >> 5 : 0u].x >> (hit.index & 31u)) & 1u) != 0u;
        uint emitter = appendTo(params.bounce, kListEmitters, emits);
        if (emits)
            params.numbers.data[kListEmitters * params.batch + emitter] = i;
    }
    if (kLast)
        return;

    vec3 albedo = kPlainAlbedo;
    if (kFormat != kFormatNone)
        albedo = decodeSrgb(unpackUnorm4x8(stored.color).rgb);
    state.throughput *= albedo;
    float strongest = max(state.throughput.r, max(state.throughput.g, state.throughput.b));
    bool goes_on = hits && hitFace(hit) != kFaceInside && strongest > 0.0;
    vec2 other = samplePair(params.sample_index, state.seed, params.bounce * kPathPairs + kPairOther);
    if (kRoulette && params.bounce >= kRouletteFirst)
    {
        float survives = min(strongest, kRouletteMax);
        goes_on = goes_on && other.y < survives;
        state.throughput /= max(survives, 1e-20);
    }

    // The next ray: directions by their cosine with the normal.
    state.normal = normalOfHit(min(hitFace(hit), 2u), ray.inverse_direction);
    vec3 normal = normalAxis(state.normal);
    LitPlace place = LitPlace(pointOfHit(hit, ray, normal), normal);
    vec2 u = samplePair(params.sample_index, state.seed, params.bounce * kPathPairs + kPairDirection);
    float angle = 2.0 * kPi * u.y;
    float cosine = sqrt(1.0 - u.x);
    vec3 direction = frameAround(normal) * vec3(sqrt(u.x) * vec2(cos(angle), sin(angle)), cosine);
    state.density = cosine / kPi;
    state.kinds = kindsAt(place, state.normal);
    uint next = appendTo(params.bounce + 1u, kListPaths, goes_on);
    if (goes_on)
    {
        storeRay(params.next_rays, next, Ray(place.position, 0.0, inverseDirection(direction), kTraceTimeMax));
        storeState(params.next_states, next, state);
    }

    // A light to look for.
    if (kSampling == kSampleChance)
        return;
    bool in_map = goes_on && other.x < state.kinds.x + state.kinds.y;
    uint map_light = appendTo(params.bounce, kListMapLights, in_map);
    if (in_map)
        params.numbers.data[kListMapLights * params.batch + map_light] = next;
    if (!kEmission)
        return;
    bool in_voxels = goes_on && !in_map && state.kinds.z > 0.0;
    uint voxel_light = appendTo(params.bounce, kListVoxelLights, in_voxels);
    if (in_voxels)
        params.numbers.data[kListVoxelLights * params.batch + voxel_light] = next;
}
