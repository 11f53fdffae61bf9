#version 460
// SPDX-License-Identifier: MIT
// A picture in another size: each pixel is the one in which its centre lies.
#extension GL_GOOGLE_include_directive : require
#include "present/present.h"
#include "lib/dispatch.glsl"

layout(local_size_x = kScaleGroup) in;
layout(push_constant, scalar) uniform Push
{
    ScaleParams params;
};

// In integers, so that all devices show the same.
uint nearest(uint place, uint to_size, uint from_size)
{
    return (2u * place + 1u) * from_size / (2u * to_size);
}

void main()
{
    uint column = threadIndex() % params.to_size.x;
    uint first = threadIndex() / params.to_size.x * kScaleRows;
    uint last = min(first + kScaleRows, params.to_size.y);
    uint from_column = nearest(column, params.to_size.x, params.from_size.x);
    for (uint y = first; y < last; ++y)
    {
        uint from_row = nearest(y, params.to_size.y, params.from_size.y);
        params.to.data[y * params.to_size.x + column] = params.from.data[from_row * params.from_size.x + from_column];
    }
}
