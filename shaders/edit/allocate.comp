#version 460
// SPDX-License-Identifier: MIT
// Allocates the children, or voxels, of changed cells, in the order of cells. One workgroup walks over the cells.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"
#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"

layout(constant_id = 0) const bool kAttributes = false; // voxels take room

layout(local_size_x = kScanGroup) in;
layout(push_constant, scalar) uniform Push
{
    EditAllocateParams params;
};

void main()
{
    EditState from = params.states.data[params.from];
    EditState kept = params.states.data[params.kept];
    uint node_top = max(from.node_top, kept.node_top);
    // A word of the emission table belongs to a single dab.
    uint voxel_top = (max(from.voxel_top, kept.voxel_top) + 31u) & ~31u;
    for (uint first = 0u; first < params.cell_count; first += kScanGroup)
    {
        uint i = first + gl_LocalInvocationIndex;
        uint count = 0u;
        bool is_leaf = i >= params.inner_count;
        if (i < params.cell_count)
        {
            EditCell cell = params.cells.data[i];
            count = cell.changed * (bitCount(cell.mask_lo) + bitCount(cell.mask_hi));
        }
        uint nodes;
        uint nodes_before = workgroupExclusiveAdd(is_leaf ? 0u : count, nodes);
        uint voxels;
        uint voxels_before = workgroupExclusiveAdd(kAttributes && is_leaf ? count : 0u, voxels);
        if (i < params.cell_count)
            params.cells.data[i].first = is_leaf ? voxel_top + voxels_before : node_top + nodes_before;
        node_top += nodes;
        voxel_top += voxels;
    }
    if (gl_LocalInvocationIndex == 0u)
    {
        bool fits = node_top <= params.node_end && voxel_top <= params.voxel_end;
        uint more = params.states.data[params.to].voxel_count;
        params.states.data[params.to] = EditState(fits ? node_top : from.node_top, fits ? voxel_top : from.voxel_top,
                                                  from.voxel_count + (fits ? more : 0u), fits ? 0u : 1u);
    }
}
