#version 460
// SPDX-License-Identifier: MIT
// Traces a list of rays.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"

layout(local_size_x = kRaysGroup) in;
layout(push_constant, scalar) uniform Push
{
    RaysParams params;
};

#define TRAVERSE_GROUP kRaysGroup
#include "lib/octree_half.glsl"
#include "lib/traverse.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= params.ray_count)
        return;
    Ray ray; // by members: GPU-assisted validation takes the struct for larger than it is
    ray.origin = params.rays.data[i].origin;
    ray.t_min = params.rays.data[i].t_min;
    ray.inverse_direction = params.rays.data[i].inverse_direction;
    ray.t_max = params.rays.data[i].t_max;
    bool valid = isTraceable(ray);
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    // An invalid ray goes through as one that ends before it starts.
    Traversal result = traverse(valid ? ray.origin : vec3(0.0), valid ? ray.inverse_direction : vec3(1.0),
                                valid ? ray.t_min : 1.0, valid ? ray.t_max : 0.0, params.detail);
    if (result.capped)
        atomicAdd(params.status.data[0].capped_rays, 1u);
    storeHit(params.hits, i, result.t, result.hit ? result.index : kHitMiss, result.cell, result.level, result.face);
}
