#version 460
// SPDX-License-Identifier: MIT
// Divides triangles into pieces that a thread walks: counts them, then lists them.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesPiecesParams, BASELINE_SLIDES_PIECES_CONSTANTS);
layout(local_size_x = kChunkTriangles) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

const bool kThin = kCoverage == kCoverageThin;

#define COLOR_BINDING 15
#include "baseline/slides_triangle.glsl"
#include "voxelize/loads.glsl"

void countDropped(uint fate)
{
    if (fate == kSlidesNonfinite)
        atomicAdd(params.counters.data[0].nonfinite, 1u);
    if (fate == kSlidesOutOfRange)
        atomicAdd(params.counters.data[0].out_of_range, 1u);
    if (fate == kSlidesOutside)
        atomicAdd(params.counters.data[0].outside, 1u);
    if (fate == kSlidesZeroArea)
        atomicAdd(params.counters.data[0].zero_area, 1u);
}

void main()
{
    uint number = kSingle ? threadIndex() : workgroupIndex();
    if (number >= params.chunk_count)
        return;
    Chunk chunk = params.chunks.data[number];
    uint triangle = chunk.first_triangle + (kSingle ? 0u : gl_LocalInvocationIndex);
    uint slot = params.first_slot + (kSingle ? number : number * kChunkTriangles + gl_LocalInvocationIndex);
    Draw draw = loadDraw(chunk.draw);
    uint count = 0u;
    if (triangle < draw.triangle_count)
    {
        SlidesSnapped snapped = slidesSnap(draw, loadTriangle(draw.first_triangle + triangle));
        if (!kList)
            countDropped(snapped.fate);
        if (snapped.fate == kSlidesKept)
        {
            i64vec3 normal;
            count = slidesPieces(slidesTriangle(snapped, normal)).count;
        }
    }
    if (!kList)
        params.piece_counts.data[slot] = count;
    else
    {
        uint first = params.piece_counts.data[slot];
        for (uint i = 0u; i < count; ++i)
            params.pieces.data[first + i] = SlidesPiece(chunk.draw, triangle, i);
    }
}
