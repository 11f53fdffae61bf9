#version 460
// SPDX-License-Identifier: MIT
// A host's own fragment shader, with light that zvo keeps on the voxels of the same meshes.
#extension GL_GOOGLE_include_directive : require
#include "zvo/trace.glsl"

layout(location = 0) in vec3 world;
layout(location = 1) in vec3 world_normal;
layout(location = 2) in vec3 code; // sRGB
layout(push_constant, scalar) uniform Push
{
    mat4 to_clip;
    vec3 place;
    float mirror; // the part of light that is reflected as by a mirror
    zvo_TreeTable_ConstPtr tree;
    zvo_RadianceCacheTable_ConstPtr cache;
    vec3 eye;
    uint frame;
    vec3 emission;
};
layout(location = 0) out vec4 color;

void main()
{
    vec3 normal = normalize(world_normal);
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    // Without a ray. Where nothing is cached yet, as on what has just moved, a few rays find what is cached elsewhere.
    vec4 light = zvo_irradiance(cache, tree, world, normal);
    if (light.w < 0.5)
        light = zvo_gatherIrradiance(cache, tree, world, normal, 16u, pixel.x + 4096u * pixel.y + (frame << 24));
    vec3 radiance = emission + zvo_decodeSrgb(code) * light.rgb;
    if (mirror > 0.0)
    {
        vec3 direction = reflect(normalize(world - eye), normal);
        vec3 origin = world + 3.0 * tree.data[0].voxel_size * normal; // past its own voxels
        zvo_Hit hit = zvo_trace(tree, origin, direction, 0.0, zvo_kTraceTimeMax);
        radiance = mix(radiance, zvo_cachedRadiance(cache, tree, hit, origin, direction).rgb, mirror);
    }
    color = vec4(zvo_develop(radiance, 1.0, pixel, 255.0), 1.0);
}
