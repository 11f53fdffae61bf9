#version 460
// SPDX-License-Identifier: MIT
// A host's own compute shader: rays through zvo's voxels, and what they hit.
#extension GL_GOOGLE_include_directive : require
#include "zvo/trace.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba8) uniform writeonly image2D picture;
layout(push_constant, scalar) uniform Push
{
    zvo_TreeTable_ConstPtr tree;
    zvo_CameraRays camera;
    uint shows_normals;
};

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uvec2 size = uvec2(imageSize(picture));
    // Unit space: zvo's own rays, so that hits are those of zvo's pictures, bit for bit.
    vec3 direction = zvo_pixelDirection(camera, false, pixel, size);
    zvo_Ray ray = zvo_unitRay(zvo_pixelOrigin(camera, false, pixel, size), direction, 0.0, zvo_kTraceTimeMax);
    zvo_Hit hit = zvo_traceRay(tree, ray);
    zvo_Surface surface = zvo_surface(tree, hit, direction);
    vec3 color = shows_normals != 0u ? 0.5 + 0.5 * surface.normal : zvo_encodeSrgb(surface.base_color);
    if (all(lessThan(pixel, size)))
        imageStore(picture, ivec2(pixel), zvo_isHit(hit) ? vec4(color, 1.0) : vec4(0.0, 0.0, 0.0, 1.0));
}
