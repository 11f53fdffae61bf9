#version 460
// SPDX-License-Identifier: MIT
// A host's kernel: the light that zvo keeps on voxels, at points with a normal, and where rays hit.
#extension GL_GOOGLE_include_directive : require
#include "zvo/trace.glsl"

layout(local_size_x = 32) in;

struct Place
{
    vec3 position; // of a surface, and where a ray begins
    vec3 normal;
    vec3 direction; // of the ray
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Places
{
    Place place[];
};

struct Light
{
    vec4 irradiance;
    vec4 gathered;
    vec4 met; // what the ray sees
    float open;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Lights
{
    Light light[];
};

layout(push_constant, scalar) uniform Push
{
    zvo_RadianceCacheTable_ConstPtr cache;
    zvo_TreeTable_ConstPtr tree;
    Places places;
    Lights results;
    uint count;
    uint rays;
    float reach;
    uint seed;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    Place at = places.place[i];
    Light light;
    light.irradiance = zvo_irradiance(cache, tree, at.position, at.normal);
    light.gathered = zvo_gatherIrradiance(cache, tree, at.position, at.normal, rays, seed + i);
    zvo_Hit hit = zvo_trace(tree, at.position, at.direction, 0.0, zvo_kTraceTimeMax);
    light.met = zvo_cachedRadiance(cache, tree, hit, at.position, at.direction);
    light.open = zvo_occlusion(tree, at.position, at.normal, rays, reach, seed + i);
    results.light[i] = light;
}
