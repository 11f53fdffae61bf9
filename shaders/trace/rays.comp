#version 460
// SPDX-License-Identifier: MIT
// Traces a list of rays. Those that use up their iterations resume in another round.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"

GPU_ENTRY(RaysParams, TRACE_RAYS_CONSTANTS);
layout(local_size_x = kRaysGroup) in;

#define NODES_BINDING 0
#define GROUPS_BINDING 1
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/half_node.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "lib/traverse.glsl"
#include "trace/rounds.glsl"

void main()
{
    uint i = threadIndex();
    uint ray_count = params.ray_count;
    if (kCounted)
        ray_count = params.list_length.data[0];
    if (i >= ray_count)
        return;
    uvec3 from = uvec3(0u);
    if (kResume)
    {
        Hit last = loadHit(Hit_ConstPtr(uint64_t(params.hits)), i);
        if (last.index != kHitUnfinished)
            return;
        from = limitsAfter(last.t, hitFace(last));
    }
    Ray ray = loadRay(params.rays, i);
    bool valid = isTraceable(ray);
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    g_leaf_groups = uint64_t_ConstPtr(uint64_t(params.leaf_groups));
    // An invalid ray is replaced by one that ends before it starts.
    Traversal result = traverse(valid ? ray.origin : vec3(0.0), valid ? ray.inverse_direction : vec3(1.0),
                                valid ? ray.t_min : 1.0, valid ? ray.t_max : 0.0, params.detail, from, kIterationsMax);
    if (result.unfinished)
        endUnfinished(kMore, params.next_round, (ray_count - 1u) / kRaysGroup + 1u, params.status);
    uint miss = kMore && result.unfinished ? kHitUnfinished : kHitMiss;
    storeHit(params.hits, i, result.t, result.hit ? result.index : miss, result.cell, result.level, result.face);
}
