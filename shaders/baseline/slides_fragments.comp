#version 460
// SPDX-License-Identifier: MIT
// The voxels that a piece of a triangle covers: counts them, or, in a second walk, writes their Morton codes and
// attributes behind those of the pieces before.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesFragmentsParams, BASELINE_SLIDES_FRAGMENTS_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"

const bool kThin = kCoverage == kCoverageThin;
const bool kShades = kAttributes && kEmit;
// What voxelize/shading.glsl asks for.
const uint kMode = kShades ? kModeAttributes : kModeCoverage;
const bool kEmits = false;

#define COLOR_BINDING 15
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#include "baseline/slides_triangle.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/surface.glsl"

SlidesFragment packFragment(uvec3 color, ivec3 normal)
{
    uvec3 biased = uvec3(normal) + normalBias(0u);
    return SlidesFragment(color.r | (color.g << 16), color.b | (biased.x << 16), biased.y | (biased.z << 16));
}

// Whether the fragment of a voxel exists; writes it as number `at`.
bool takeVoxel(Surface surface, uvec3 weights, uvec4 color, uvec3 voxel, uint at)
{
    if (kMaterialClass == kClassAlpha && !passesAlpha(surface, color.a, voxel))
        return false;
    if (kEmit)
    {
        uvec2 code = mortonEncodeWide(voxel);
        params.keys.data[at] = uint64_t(code.x) | (uint64_t(code.y) << 30);
    }
    if (kShades)
        params.fragments.data[at] = packFragment(color.rgb, fragmentNormal(surface, weights));
    return true;
}

// Returns the number of fragments in the rows and columns from `from` to `to`.
uint walkRows(SlidesTriangle t, Surface surface, ivec2 from, ivec2 to, uint first_fragment)
{
    uint count = 0u;
    for (int row = from.y; row <= to.y; ++row)
    {
        ivec2 columns = slidesColumns(t, row, from.x, to.x);
        SlidesLayers layers = slidesLayers(t, ivec2(columns.x, row));
        i64vec3 vw = edgesAt(t.vw, row, 0);
        for (int column = columns.x; column <= columns.y; ++column)
        {
            uvec3 weights = uvec3(0u);
            uvec4 color = uvec4(0u);
            if (kShades || kMaterialClass == kClassAlpha)
            {
                weights = fixedWeights(slidesCorners(t, ivec2(column, row)), t.n.z != 0);
                color = fragmentColor(surface, weights);
            }
            i64vec3 wu = edgesAt(t.wu, 0, column);
            ivec2 range = layerRange(t, layers);
            for (int layer = range.x; layer <= range.y; ++layer)
                if (leftByEdges(t, vw, wu, layer) &&
                    takeVoxel(surface, weights, color, slidesVoxel(t, ivec2(column, row), layer),
                              first_fragment + count))
                    ++count;
            stepLayers(t, layers);
        }
    }
    return count;
}

void main()
{
    uint number = threadIndex();
    if (number >= params.piece_count)
        return;
    SlidesPiece piece = params.pieces.data[number];
    Draw draw = loadDraw(piece.draw);
    uvec3 vertices = loadTriangle(draw.first_triangle + piece.triangle);
    i64vec3 normal;
    SlidesTriangle t = slidesTriangle(slidesSnap(draw, vertices), normal);
    Surface surface;
    if (kShades || kMaterialClass == kClassAlpha)
        surface = loadSurface(draw, vertices, vec3(normal), float(t.n.z));
    SlidesPieces pieces = slidesPieces(t);
    ivec2 place = ivec2(piece.number % pieces.count_columns, piece.number / pieces.count_columns);
    ivec2 from = t.low.xy + place * ivec2(pieces.columns, pieces.rows);
    ivec2 to = min(from + ivec2(pieces.columns, pieces.rows) - 1, t.high.xy);
    uint first_fragment = kEmit ? params.fragment_counts.data[number] : 0u;
    uint count = walkRows(t, surface, from, to, first_fragment);
    if (!kEmit)
        params.fragment_counts.data[number] = count;
}
