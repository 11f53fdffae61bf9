#version 460
// SPDX-License-Identifier: MIT
// A host's kernel: rays in world space, and whether anything is in their way.
#extension GL_GOOGLE_include_directive : require
#define ZVO_DETAIL
#include "zvo/trace.glsl"

layout(local_size_x = 32) in;

struct WorldRay
{
    vec3 origin;
    float t_min;
    vec3 direction;
    float t_max;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer WorldRays
{
    WorldRay ray[];
};

struct Met
{
    zvo_Hit hit;
    zvo_Hit coarse; // nodes of at most `detail` world units
    vec3 position;
    uint occluded;
};
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer Mets
{
    Met met[];
};

layout(push_constant, scalar) uniform Push
{
    zvo_TreeTable_ConstPtr tree;
    WorldRays rays;
    Mets results;
    uint count;
    float detail;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    WorldRay ray = rays.ray[i];
    Met met;
    met.hit = zvo_trace(tree, ray.origin, ray.direction, ray.t_min, ray.t_max);
    met.coarse = zvo_traceDetail(tree, ray.origin, ray.direction, ray.t_min, ray.t_max, vec2(0.0, detail));
    met.position = zvo_position(tree, met.hit, ray.origin, ray.direction);
    met.occluded = zvo_occluded(tree, ray.origin, ray.direction, ray.t_min, ray.t_max) ? 1u : 0u;
    results.met[i] = met;
}
