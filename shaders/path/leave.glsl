// SPDX-License-Identifier: MIT
// How a path leaves a face: in a random direction, with a kind of light to look for. The includer includes path/path.h,
// lib/frame.glsl, lib/hit.glsl, lib/ray.glsl, lib/sobol.glsl, light/importance.glsl, path/face.glsl and
// path/numbers.glsl before and declares kNodeLevels, kEmission and params.
#ifndef ZVO_SHADERS_PATH_LEAVE_GLSL
#define ZVO_SHADERS_PATH_LEAVE_GLSL

#include "lib/face.glsl"
#include "lib/ray.glsl"
#include "lib/sampling.glsl"
#include "light/importance.glsl"
#include "path/numbers.glsl"
#include "path/path.h"

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

// How probable it is that light is looked for in the map, the sun and voxels, at a place: half of it in the same way
// for all that may give any, half in proportion to how much it may give.
vec3 kindsAt(LitPlace place, uint normal)
{
    vec3 gives = vec3(uintBitsToFloat(unpackUint2x32(uint64_t_ConstPtr(uint64_t(params.gives)).data[normal])), 0.0);
    if (kEmission)
        gives.z = lightImportance(place, 0u, false) * exp2(-4.0 * float(kNodeLevels));
    vec3 present = vec3(gives.x > 0.0 ? 1.0 : 0.0, gives.y > 0.0 ? 1.0 : 0.0, gives.z > 0.0 ? 1.0 : 0.0);
    float count = present.x + present.y + present.z;
    return count == 0.0 ? vec3(0.0) : 0.5 * present / count + 0.5 * gives / (gives.x + gives.y + gives.z);
}

// Sets all that follows from a random direction, by its cosine with the normal: the path's density, kinds of light and
// ray. state: has the normal of the face.
void leaveFace(vec3 position, uint bounce, inout NextRay next)
{
    const float pi = 3.14159265358979;
    vec3 normal = normalAxis(next.state.normal);
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

#endif
