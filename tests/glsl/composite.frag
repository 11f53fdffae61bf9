#version 460
// SPDX-License-Identifier: MIT
// A host's fragment shader over the whole picture, or over the sides of the grid: voxels among rasterized meshes.
#extension GL_GOOGLE_include_directive : require
#include "zvo/trace.glsl"

layout(set = 0, binding = 0, std140) uniform View
{
    mat4 view_projection;
    mat4 inverse_view_projection;
    vec4 eye;
    vec4 to_sun;
    uvec2 size;
};
layout(set = 0, binding = 1) uniform sampler2D environment;
layout(push_constant, scalar) uniform Push
{
    zvo_TreeTable_ConstPtr tree;
};
layout(location = 0) out vec4 color;

void main()
{
    vec2 ndc = 2.0 * gl_FragCoord.xy / vec2(size) - 1.0;
    vec4 point = inverse_view_projection * vec4(ndc, 0.5, 1.0);
    vec3 direction = normalize(point.xyz / point.w - eye.xyz);
    zvo_Hit hit = zvo_trace(tree, eye.xyz, direction, 0.0, 1e30);
    if (!zvo_isHit(hit))
        discard;
    vec3 position = zvo_position(tree, hit, eye.xyz, direction);
    zvo_Surface surface = zvo_surface(tree, hit, direction);
    vec3 above = surface.middle + surface.edge * (surface.face_normal + 0.75 * surface.normal);
    float sun = zvo_occluded(tree, above, to_sun.xyz, 0.0, 1e30) ? 0.0 : max(dot(surface.normal, to_sun.xyz), 0.0);
    vec3 sky = texture(environment, surface.normal.xz).rgb;
    color = vec4(surface.base_color * (sun + sky) + surface.emission, 1.0);
    gl_FragDepth = zvo_depth(view_projection, position);
}
