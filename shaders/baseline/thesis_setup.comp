#version 460
// SPDX-License-Identifier: MIT
// First pass of the thesis's voxelization: a thread a triangle computes what the test of a voxel needs (M. Schwarz,
// H.-P. Seidel, Fast Parallel Surface and Solid Voxelization on GPUs, 2010). The thesis computes in floating point;
// here vertices are snapped to zvo's lattice, and everything is an integer, so that voxels can be compared.
#extension GL_GOOGLE_include_directive : require
#include "baseline/thesis.h"

GPU_ENTRY(ThesisSetupParams, BASELINE_THESIS_SETUP_CONSTANTS);
layout(local_size_x = kThesisGroup) in;

#include "lib/arithmetic.glsl"
#include "lib/dispatch.glsl"

const bool kThin = kCoverage == kCoverageThin;

#include "baseline/thesis_triangle.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/vertex.glsl"
#include "voxelize/window.glsl"

// What a triangle outside of the grid, or none at all, leaves behind.
ThesisTriangle noTriangle()
{
    const ivec3 none = ivec3(0);
    return ThesisTriangle(none, none, none, ivec2(0), ivec2(0), ivec2(0), ivec3(1), none, 0u, 0u, 0u);
}

ThesisTriangle setUp(uint draw_number, uint triangle)
{
    Draw draw = loadDraw(draw_number);
    uvec3 vertices = loadTriangle(draw.first_triangle + triangle);
    vec3 p0 = worldPosition(draw, vertices.x);
    vec3 p1 = worldPosition(draw, vertices.y);
    vec3 p2 = worldPosition(draw, vertices.z);
    vec3 q0 = latticePosition(p0);
    vec3 q1 = latticePosition(p1);
    vec3 q2 = latticePosition(p2);
    if (!(isFinite(p0) && isFinite(p1) && isFinite(p2) && onLattice(q0) && onLattice(q1) && onLattice(q2)))
        return noTriangle();
    ivec3 v0 = ivec3(q0);
    ivec3 v1 = ivec3(q1);
    ivec3 v2 = ivec3(q2);
    i64vec3 a = i64vec3(v1 - v0);
    i64vec3 b = i64vec3(v2 - v0);
    i64vec3 normal = a.yzx * b.zxy - a.zxy * b.yzx;
    // A closed range [min, max] touches the closed voxels from ceil(min / 256) - 1 to floor(max / 256).
    ivec3 low = ((min(v0, min(v1, v2)) + (kVoxelLattice - 1)) >> kVoxelLatticeLog2) - 1;
    ivec3 high = max(v0, max(v1, v2)) >> kVoxelLatticeLog2;
    clipToWindow(low, high);
    if (any(greaterThan(low, high)) || (kThin && normal == i64vec3(0)))
        return noTriangle();
    uint axis = majorAxis(normal, low, high);
    return packTriangle(setupTriangle(v0, v1, v2, normal, axis, low, high, gridResolution()), normal, draw_number,
                        triangle);
}

void main()
{
    uint index = threadIndex();
    uint chunk = index / params.chunk_triangles;
    if (chunk >= params.chunk_count)
        return;
    Chunk taken = params.chunks.data[chunk];
    uint triangle = taken.first_triangle + index % params.chunk_triangles;
    ThesisTriangle result = noTriangle();
    if (triangle < params.scene.data[0].draws.data[taken.draw].triangle_count)
        result = setUp(taken.draw, triangle);
    uint number = params.first_triangle + index;
    params.triangles.data[number] = result;
    uvec3 extent = uvec3(max(result.high - result.low + 1, ivec3(0)));
    if (extent.x != 0u)
    {
        uint columns = thesisColumns(params.cells_per_part, extent.z);
        uint parts = (extent.x * extent.y + columns - 1u) / columns;
        atomicMax(params.counters.data[0].part_count, parts);
        if (parts > 1u)
            params.big.data[atomicAdd(params.counters.data[0].big_count, 1u)] = number;
    }
}
