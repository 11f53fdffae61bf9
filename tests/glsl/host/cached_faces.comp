#version 460
// SPDX-License-Identifier: MIT
// A host's kernel: copies the table of faces that keep light.
#extension GL_GOOGLE_include_directive : require
#include "zvo/trace.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push
{
    zvo_RadianceCacheTable_ConstPtr cache;
    zvo_uvec4_Ptr results; // [1 + slots] numbers of runs and frames, then keys and light
    uint slots;            // that there is room for
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    bool has_light = uint64_t(cache.data[0].faces) != 0ul;
    uint count = has_light ? min(slots, cache.data[0].run_count * zvo_kFaceRun) : 0u;
    if (i == 0u)
        results.data[0] = uvec4(has_light ? cache.data[0].run_count : 0u, cache.data[0].frame_count, 0u, 0u);
    if (i >= slots)
        return;
    uvec4 words = uvec4(0u);
    if (i < count)
    {
        zvo_CachedFace face = cache.data[0].faces.data[i];
        words = uvec4(face.key, face.light);
    }
    results.data[1u + i] = words;
}
