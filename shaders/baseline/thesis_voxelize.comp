#version 460
// SPDX-License-Identifier: MIT
// Second pass of the thesis's voxelization: a thread a triangle tests every voxel of the triangle's bounding box. So it
// is on GPUs. Software devices end the loops of a thread after 65,535 iterations, which the lanes of a subgroup add up:
// there a thread tests a part of its box, and further dispatches test the other parts of the boxes that have some.
#extension GL_GOOGLE_include_directive : require
#include "baseline/thesis.h"

GPU_ENTRY(ThesisVoxelizeParams, BASELINE_THESIS_VOXELIZE_CONSTANTS);
layout(local_size_x = kThesisGroup) in;

#include "lib/dispatch.glsl"
#include "lib/morton.glsl"

const bool kThin = kCoverage == kCoverageThin;
const uint kMode = kTarget == kThesisOccupancy ? kModeCoverage : kModeAttributes;
const bool kEmits = false;

#include "baseline/thesis_triangle.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/resolve.glsl"
#include "voxelize/surface.glsl"
#include "voxelize/sums.glsl"
#include "voxelize/window.glsl"

void store(uvec3 voxel, uint code, uvec3 color, ivec3 normal)
{
    VoxelSums sums = sumsOf(color, normal);
    Attribute look = Attribute(kOpaqueColor, 0u);
    if (kTarget == kThesisColors || kTarget == kThesisFragments)
        look = resolveSums(params.scene, sums, 0u, kOpaqueColor >> 24);
    if (kTarget == kThesisSums)
    {
        addToSums(code, sums);
    }
    else if (kTarget == kThesisFragments)
    {
        uint i = atomicAdd(params.counters.data[0].fragment_count, 1u);
        if (i < params.fragment_capacity)
            params.fragments.data[i] = VoxelFragment(voxel.x | (voxel.y << 16), voxel.z, look.color, look.normal);
    }
    else
    {
        uint64_t_Ptr(uint64_t(params.cells)).data[code] = packAttribute(look); // one store: no mixture of two writers
    }
}

// codes: the smallest and the largest so far.
void emitFragment(RasterTriangle t, Surface surface, EDGE_IVEC3 corners, uvec3 voxel, inout uvec2 codes)
{
    uvec4 color = uvec4(0u);
    ivec3 normal = ivec3(0);
    bool exists = true;
    if (kMode == kModeAttributes || kMaterialClass == kClassAlpha)
    {
        uvec3 weights = fixedWeights(corners, t.n_w != 0);
        color = fragmentColor(surface, weights);
        if (kMode == kModeAttributes)
            normal = fragmentNormal(surface, weights);
        if (kMaterialClass == kClassAlpha)
            exists = passesAlpha(surface, color.a, voxel);
    }
    if (exists)
    {
        uint code = mortonEncode(voxel);
        codes = uvec2(min(codes.x, code), max(codes.y, code));
        store(voxel, code, color.rgb, normal);
    }
}

// The state at the lowest layer of the box in the column of first, whose layer is the lowest that the plane crosses.
RasterCell lowestCell(RasterTriangle t, RasterCell first)
{
    RasterCell cell = first;
    EDGE_INT steps = EDGE_INT(first.w - t.low.z) * EDGE_INT(kVoxelLattice);
    cell.vw += EDGE_IVEC3(t.edge_v) * steps;
    cell.wu -= EDGE_IVEC3(t.edge_u) * steps;
    cell.w = t.low.z;
    return cell;
}

// Tests the cells of count columns from column on. A voxel is tested by the range of layers that the plane crosses in
// its column, and by nine edge functions; both are stepped by additions, as Schwarz and Seidel propose.
uvec2 walkBox(RasterTriangle t, Surface surface, ivec2 column, uint count)
{
    uvec2 codes = uvec2(~0u, 0u);
    RasterCell row = startColumn(t, ivec2(t.low.x, column.y));
    RasterCell first = startColumn(t, column);
    RasterCell cell = lowestCell(t, first);
    for (uint left = count; left != 0u;)
    {
        bool found = false;
        ivec3 found_at = ivec3(0);
        EDGE_IVEC3 corners = EDGE_IVEC3(0);
        for (; left != 0u && !found;)
        {
            int w_high = kThin ? first.w : first.w_high;
            for (; cell.w <= t.high.z && !found;)
            {
                EDGE_IVEC3 signs = cell.uv | cell.vw | cell.wu;
                found = (signs.x | signs.y | signs.z) >= 0 && cell.w >= first.w && cell.w <= w_high;
                moveUp(t, true, cell);
            }
            found_at = ivec3(column, cell.w - 1);
            corners = cornerWeights(t, cell);
            if (cell.w > t.high.z)
            {
                bool row_ends = column.x == t.high.x;
                if (row_ends)
                    nextRow(t, row);
                else
                    nextColumn(t, first);
                if (row_ends)
                    first = row;
                column = row_ends ? ivec2(t.low.x, column.y + 1) : ivec2(column.x + 1, column.y);
                cell = lowestCell(t, first);
                --left;
            }
        }
        if (found)
            emitFragment(t, surface, corners, uvec3(voxelOf(t, found_at.xy, found_at.z)), codes);
    }
    return codes;
}

void main()
{
    bool listed = params.big_count != 0u;
    uint index = threadIndex() / (listed ? kThesisParts : 1u);
    uint part = params.first_part + (listed ? threadIndex() % kThesisParts : 0u);
    if (index >= (listed ? params.big_count : params.triangle_count))
        return;
    uint number = params.first_triangle + index;
    if (listed)
        number = params.big.data[index];
    if (number - params.first_triangle >= params.triangle_count)
        return;
    ThesisTriangle packed = params.triangles.data[number];
    uvec3 extent = uvec3(max(packed.high - packed.low + 1, ivec3(0)));
    uint columns = extent.x * extent.y;
    uint columns_max = thesisColumns(params.cells_per_part, max(extent.z, 1u));
    uint first = part * columns_max;
    if (first >= columns)
        return;
    RasterTriangle t = unpackTriangle(packed, gridResolution());
    Draw draw = loadDraw(packed.draw);
    Surface surface;
    if (kMode == kModeAttributes || kMaterialClass == kClassAlpha)
        surface = loadSurface(draw, loadTriangle(draw.first_triangle + packed.triangle), latticeNormal(t, packed.bits),
                              float(t.n_w));
    ivec2 column = t.low.xy + ivec2(first % extent.x, first / extent.x);
    uvec2 codes = walkBox(t, surface, column, min(columns - first, columns_max));
    if (kBounds && codes.x <= codes.y)
    {
        atomicMin(params.counters.data[0].code_min, codes.x);
        atomicMax(params.counters.data[0].code_max, codes.y);
    }
}
