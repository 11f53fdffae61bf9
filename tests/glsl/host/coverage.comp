#version 460
// SPDX-License-Identifier: MIT
// The share of a node's columns in which it has children, along each axis.
#extension GL_GOOGLE_include_directive : require
#define ZVO_DETAIL
#include "zvo/trace.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push
{
    zvo_uvec2_ConstPtr masks;
    zvo_vec3_Ptr results;
    uint count;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    uvec2 mask = masks.data[i];
    results.data[i] = vec3(zvo_coverageAlong(mask, 0u), zvo_coverageAlong(mask, 1u), zvo_coverageAlong(mask, 2u));
}
