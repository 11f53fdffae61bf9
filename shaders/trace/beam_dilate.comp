#version 460
// SPDX-License-Identifier: MIT
// Second pass of the beam grid: sets the cells that touch an occupied cell, or have a neighbour that does.
#extension GL_GOOGLE_include_directive : require
#include "trace/beam.h"
#include "lib/dispatch.glsl"

layout(local_size_x = kBeamGroup) in;
layout(push_constant, scalar) uniform Push
{
    BeamDilateParams params;
};

// First and last occupied cell, along one axis, that beam cell b and its neighbours touch; last < first: none. The
// inner kBeamCells - 2 beam cells cover the cube.
ivec2 touched(uint b)
{
    int inner = int(kBeamCells) - 2;
    int cells = int(params.cells);
    int first = max(int(b) - 2, 0) * cells / inner;
    int last = (min(int(b) + 1, inner) * cells + inner - 1) / inner - 1;
    return ivec2(first, min(last, cells - 1));
}

void main()
{
    uint row = threadIndex();
    if (row >= kBeamRows)
        return;
    ivec2 y = touched(row % kBeamCells);
    ivec2 z = touched(row / kBeamCells);
    uint64_t near = 0ul;
    for (int k = z.x; k <= z.y; ++k)
        for (int j = y.x; j <= y.y; ++j)
            near |= params.occupied.data[uint(k) * params.cells + uint(j)];
    uint64_t bits = 0ul;
    for (uint b = 0u; b < kBeamCells; ++b)
    {
        ivec2 x = touched(b);
        uint64_t range = (near >> uint(x.x)) << uint(63 - max(x.y - x.x, 0)); // bits x.x to x.y on top
        bits |= uint64_t(range != 0ul && x.x <= x.y ? 1u : 0u) << b;
    }
    params.rows.data[row] = bits;
}
