// SPDX-License-Identifier: MIT
// How a path goes on from a face: in a random direction, with a kind of light to look for.
// Needs the constants kNodeLevels, kEmission and kSmooth, params.gives, params.light_nodes, params.lists and
// params.sample_index.
#ifndef ZVO_SHADERS_PATH_NEXT_RAY_GLSL
#define ZVO_SHADERS_PATH_NEXT_RAY_GLSL

#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "lib/sampling.glsl"
#include "light/importance.glsl"
#include "path/leave_by_normal.glsl"
#include "path/lists.glsl"
#include "path/normal.glsl"
#include "path/path.h"
#include "path/state.glsl"

// How a path goes on.
struct NextRay
{
    bool exists; // else nothing else counts
    Ray ray;
    PathState state;
    float choice; // random number that chooses the kind of light to look for
};

// A point on the face with this normal of the voxel at a cell: on the face exactly, and inside of its edges.
vec3 pointOnFace(vec3 near, uvec3 cell, vec3 normal)
{
    float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 low = 1.0 + edge * vec3(cell);
    vec3 high = low + edge;
    vec3 inner_low = uintBitsToFloat(floatBitsToUint(low) + 1u);
    vec3 inner_high = uintBitsToFloat(floatBitsToUint(high) - 1u);
    vec3 point = clamp(near, inner_low, inner_high);
    return mix(mix(point, high, greaterThan(normal, vec3(0.0))), low, lessThan(normal, vec3(0.0)));
}

// What a face gets of the map, and of the sun, at most.
vec2 outsideGives(uint face)
{
    return uintBitsToFloat(unpackUint2x32(uint64_t_ConstPtr(uint64_t(params.gives)).data[face]));
}

// What a surface with any normal (length 1) gets of the map, and of the sun, at most.
vec2 outsideGives(vec3 normal)
{
    vec2 gives = vec2(0.0);
    for (uint axis = 0u; axis < 3u; ++axis)
    {
        float along = componentOf(normal, axis);
        gives += along * along * outsideGives(faceAlong(axis, normal));
    }
    return gives;
}

// How probable it is that light is looked for in the map, the sun and voxels, at a place: half of it in the same way
// for all that may give any, half in proportion to how much it may give.
vec3 kindsAt(LitPlace place, uint normal)
{
    vec3 gives = vec3(isFaceNormal(normal) ? outsideGives(normal) : outsideGives(place.normal), 0.0);
    if (kEmission)
        gives.z = lightImportance(params.light_nodes, place, 0u, false) * exp2(-4.0 * float(kNodeLevels));
    vec3 present = vec3(gives.x > 0.0 ? 1.0 : 0.0, gives.y > 0.0 ? 1.0 : 0.0, gives.z > 0.0 ? 1.0 : 0.0);
    float count = present.x + present.y + present.z;
    return count == 0.0 ? vec3(0.0) : 0.5 * present / count + 0.5 * gives / (gives.x + gives.y + gives.z);
}

// Sets all that follows from a random direction, by its cosine with the normal: the path's density, kinds of light and
// ray. state: has the normal of the surface.
void leaveFace(vec3 position, uint bounce, inout NextRay next)
{
    const float pi = 3.14159265358979;
    vec3 normal = normalOf(next.state.normal);
    vec2 u = samplePair(params.sample_index, next.state.seed, bounce * kPathPairs + kPairDirection);
    vec3 direction = cosineDirection(u.x, 2.0 * pi * u.y);
    next.state.density = direction.z / pi;
    next.state.kinds = kindsAt(LitPlace(position, normal), next.state.normal);
    next.ray = Ray(position, 0.0, inverseDirection(frameAround(normal) * direction), kTraceTimeMax);
}

// The light that a path looks for as it goes on: from outside of the grid, of voxels, or none.
bool seeksMapLight(NextRay next)
{
    return next.exists && next.choice < next.state.kinds.x + next.state.kinds.y;
}

bool seeksVoxelLight(NextRay next)
{
    return next.exists && !seeksMapLight(next) && next.state.kinds.z > 0.0;
}

const float kRouletteMax = 0.95; // probability to go on
const uint kRouletteFirst = 3u;  // bounce

// The ray by which a path goes on from a hit, if it does. normal_code: of the voxel's normal; only with kSmooth.
// roulette: whether chance may end it.
NextRay nextRay(PathState state, Ray ray, bool hits, Hit hit, vec3 albedo, uint normal_code, bool roulette, uint bounce)
{
    state.throughput *= albedo;
    float strongest = max(state.throughput.r, max(state.throughput.g, state.throughput.b));
    NextRay next;
    next.exists = hits && hitFace(hit) != kFaceInside && strongest > 0.0;
    vec2 other = samplePair(params.sample_index, state.seed, bounce * kPathPairs + kPairOther);
    next.choice = other.x;
    if (roulette && bounce >= kRouletteFirst)
    {
        float survives = min(strongest, kRouletteMax);
        next.exists = next.exists && other.y < survives;
        state.throughput /= max(survives, 1e-20);
    }

    state.normal = normalOfHit(min(hitFace(hit), 2u), ray.inverse_direction);
    vec3 point = ray.origin + hit.t / ray.inverse_direction;
    point = pointOnFace(point, hitCell(hit), normalAxis(state.normal));
    if (kSmooth && bounce == 0u)
        leaveByNormal(normal_code, ray, hit, state, point);
    next.state = state;
    leaveFace(point, bounce, next);
    return next;
}

// Lists a path by the light that it looks for. numbers: of the lists' elements, `batch` of each list. set: of lists.
// All threads of a subgroup call this together.
void listChosen(uint_Ptr numbers, uint batch, NextRay next, uint path, uint set)
{
    bool in_map = seeksMapLight(next);
    uint map_light = appendTo(set, kListMapLights, in_map);
    if (in_map)
        numbers.data[kListMapLights * batch + map_light] = path;
    if (kEmission)
    {
        bool in_voxels = seeksVoxelLight(next);
        uint voxel_light = appendTo(set, kListVoxelLights, in_voxels);
        if (in_voxels)
            numbers.data[kListVoxelLights * batch + voxel_light] = path;
    }
}

#endif
