#version 460
// SPDX-License-Identifier: MIT
// A host's kernel: the light that comes through cones, and by many rays in them.
#extension GL_GOOGLE_include_directive : require
#define ZVO_DETAIL
#include "zvo/trace.glsl"

layout(local_size_x = 32) in;

struct Cone
{
    vec3 origin;
    vec3 direction;
    float aperture;
    float reach; // in world units; for these directions, of length 1
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Cones
{
    Cone cone[];
};

struct Found
{
    vec4 one;  // by the cone, with one seed
    vec4 mean; // likewise, over as many seeds as rays
    vec4 rays; // over rays, evenly in the cone; w: the share of those that meet nothing
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Results
{
    Found found[];
};

layout(push_constant, scalar) uniform Push
{
    zvo_RadianceCacheTable_ConstPtr cache;
    zvo_TreeTable_ConstPtr tree;
    Cones cones;
    Results results;
    uint count;
    uint rays;
};

vec3 directionIn(Cone at, uint i)
{
    vec2 u = zvo_samplePair(i, 5u, 0u);
    float cosine = mix(1.0, cos(0.5 * at.aperture), u.x);
    float angle = 6.2831853 * u.y;
    vec2 aside = sqrt(1.0 - cosine * cosine) * vec2(cos(angle), sin(angle));
    return zvo_frameAround(at.direction) * vec3(aside, cosine);
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    Cone at = cones.cone[i];
    Found found = Found(zvo_cone(cache, tree, at.origin, at.direction, at.aperture, at.reach, 1u), vec4(0.0), vec4(0.0));
    for (uint k = 0u; k < rays; ++k)
    {
        found.mean += zvo_cone(cache, tree, at.origin, at.direction, at.aperture, at.reach, i * rays + k) / float(rays);
        vec3 direction = directionIn(at, k);
        zvo_Hit hit = zvo_trace(tree, at.origin, direction, 0.0, at.reach);
        vec4 met = zvo_cachedRadiance(cache, tree, hit, at.origin, direction);
        found.rays += vec4(met.rgb, zvo_isHit(hit) ? 0.0 : 1.0) / float(rays);
    }
    results.found[i] = found;
}
