// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "zvo/trace.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform Push
{
    zvo_TreeTable_ConstPtr tree;
    vec3 origin;
    vec3 direction;
};

layout(set = 0, binding = 0) writeonly buffer Depths
{
    float depths[];
};

void main()
{
    depths[gl_GlobalInvocationID.x] = zvo_trace(tree, origin, direction, 0.0, 1000.0).t;
}
