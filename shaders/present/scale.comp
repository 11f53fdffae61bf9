#version 460
// SPDX-License-Identifier: MIT
// Scales a picture: each pixel copies the one that contains its centre.
#extension GL_GOOGLE_include_directive : require
#include "present/present.h"

GPU_ENTRY(ScaleParams, GPU_NO_CONSTANTS);
layout(local_size_x = kScaleGroup) in;

#include "lib/dispatch.glsl"

// The pixel, in a line of from_size, that contains the centre of a pixel in a line of to_size: (2 pixel + 1) from_size
// / (2 to_size), rounded down, and the remainder. In integers, so that all devices show the same.
uvec2 nearest(uint pixel, uint to_size, uint from_size)
{
    uint product = (2u * pixel + 1u) * from_size;
    uint quotient = product / (2u * to_size);
    return uvec2(quotient, product - quotient * 2u * to_size);
}

void main()
{
    uint width = params.to_size.x;
    uint thread_row = threadIndex() / width;
    uint column = threadIndex() - thread_row * width;
    uint first = thread_row * kScaleRows;
    uint last = min(first + kScaleRows, params.to_size.y);
    uint from_column = nearest(column, width, params.from_size.x).x;

    // Rows are stepped by additions, because divisions are slow.
    uint divisor = 2u * params.to_size.y;
    uint step_quotient = 2u * params.from_size.y / divisor;
    uint step_rest = 2u * params.from_size.y - step_quotient * divisor;
    uvec2 row = nearest(first, params.to_size.y, params.from_size.y);
    for (uint y = first; y < last; ++y)
    {
        params.to.data[y * width + column] = params.from.data[row.x * params.from_size.x + from_column];
        row += uvec2(step_quotient, step_rest);
        bool carry = row.y >= divisor;
        row.x += carry ? 1u : 0u;
        row.y -= carry ? divisor : 0u;
    }
}
