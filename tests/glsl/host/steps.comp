#version 460
// SPDX-License-Identifier: MIT
// A host's kernel: rays in unit space that go on and on with a few iterations each, through two trees at once.
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 0) const uint kSteps = 40000u;
#define ZVO_ITERATIONS_MAX kSteps
#include "zvo/trace.glsl"

layout(local_size_x = 32) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Rays
{
    zvo_Ray ray[];
};
struct Both
{
    zvo_Hit hit[2];
    uint call_count[2];
};
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer Results
{
    Both both[];
};

layout(push_constant, scalar) uniform Push
{
    zvo_TreeTable_ConstPtr trees[2];
    Rays rays;
    Results results;
    uint count;
};

const uint kCallsMax = 2000u;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    zvo_Ray ray = rays.ray[i];
    Both result;
    for (uint k = 0u; k < 2u; ++k)
        result.hit[k] = zvo_traceRay(trees[k], ray);
    for (uint k = 0u; k < 2u; ++k)
    {
        uint calls = 1u;
        for (; calls < kCallsMax && zvo_isUnfinished(result.hit[k]); ++calls)
            result.hit[k] = zvo_resume(trees[k], ray, result.hit[k]);
        result.call_count[k] = calls;
    }
    results.both[i] = result;
}
