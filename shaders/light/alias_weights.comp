#version 460
// SPDX-License-Identifier: MIT
// Computes the weight of each cell in the table of each normal, and the heaviest ones.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"

GPU_ENTRY(AliasWeightsParams, LIGHT_ALIAS_WEIGHTS_CONSTANTS);
layout(local_size_x = kAliasGroup) in;

#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "light/outside.glsl"

shared uint s_heaviest[kNormals];

// The integral from below up to x of the weight of a texel between whose middle and its neighbours' radiance is linear;
// x is measured from the texel's middle, in texels.
float integratedTent(float x)
{
    float rest = max(1.0 - abs(x), 0.0);
    return x < 0.0 ? 0.5 * rest * rest : 1.0 - 0.5 * rest * rest;
}

// What the texel contributes to the mean over [begin, end] (in texels).
float partOf(int texel, float begin, float end)
{
    float middle = float(texel) + 0.5;
    return (integratedTent(end - middle) - integratedTent(begin - middle)) / (end - begin);
}

float meanLuminance(vec2 begin, vec2 end)
{
    ivec2 size = ivec2(params.map.width, params.map.height);
    ivec2 first = ivec2(floor(begin - 0.5));
    ivec2 last = ivec2(floor(end + 0.5));
    float mean = 0.0;
    for (int y = first.y; y <= last.y; ++y)
    {
        int row = clamp(y, 0, size.y - 1);
        for (int x = first.x; x <= last.x; ++x)
        {
            int column = x < 0 ? x + size.x : x >= size.x ? x - size.x : x;
            column = clamp(column, 0, size.x - 1);
            mean += partOf(x, begin.x, end.x) * partOf(y, begin.y, end.y) *
                    luminance(params.texels.data[row * size.x + column]);
        }
    }
    return mean;
}

void main()
{
    uint i = threadIndex();
    if (gl_LocalInvocationIndex < kNormals)
        s_heaviest[gl_LocalInvocationIndex] = 0u;
    barrier();
    uvec2 cells = uvec2(params.map.cells_x, params.map.cells_y);
    if (i < cells.x * cells.y)
    {
        uvec2 cell = uvec2(i % cells.x, i / cells.x);
        vec2 begin = vec2(cell) / vec2(cells);
        vec2 end = vec2(cell + 1u) / vec2(cells);
        vec2 size = vec2(params.map.width, params.map.height);
        vec2 y = cos(kPi * vec2(begin.y, end.y));
        float light = (kEvenly ? 1.0 : meanLuminance(begin * size, end * size)) * (y.x - y.y) * 2.0 * kPi / float(cells.x);
        vec3 corners[5] = vec3[](mapDirection(begin.x, y.x, params.map), mapDirection(end.x, y.x, params.map),
                                 mapDirection(begin.x, y.y, params.map), mapDirection(end.x, y.y, params.map),
                                 mapDirection(0.5 * (begin.x + end.x), 0.5 * (y.x + y.y), params.map));
        vec3 up = vec3(0.0);
        vec3 down = vec3(0.0);
        [[unroll]] for (uint k = 0u; k < 5u; ++k)
        {
            up += 0.2 * max(corners[k], 0.0);
            down += 0.2 * max(-corners[k], 0.0);
        }
        [[unroll]] for (uint normal = 0u; normal < kNormals; ++normal)
        {
            float weight = light * (kEvenly ? 1.0 : normal < 3u ? up[normal % 3u] : down[normal % 3u]);
            params.weights.data[normal * cells.x * cells.y + i] = floatBitsToUint(weight);
            atomicMax(s_heaviest[normal], floatBitsToUint(weight));
        }
    }
    barrier();
    if (gl_LocalInvocationIndex < kNormals)
        atomicMax(params.totals.data[0].heaviest[gl_LocalInvocationIndex], s_heaviest[gl_LocalInvocationIndex]);
}
