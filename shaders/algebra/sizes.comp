#version 460
// SPDX-License-Identifier: MIT
// Adds the voxels of each unit to those of its component, and writes a voxel of the root.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(UnitsParams, ALGEBRA_UNITS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_vote : require
#include "algebra/place.glsl"
#include "algebra/unit_masks.glsl"
#include "lib/dispatch.glsl"

void add(uint root, uvec2 size)
{
    uint before = atomicAdd(params.sizes.data[root].size_lo, size.x);
    uint high = size.y + (before + size.x < before ? 1u : 0u);
    if (high != 0u)
        atomicAdd(params.sizes.data[root].size_hi, high);
}

void main()
{
    uint number = threadIndex();
    uvec2 matter = uvec2(0u);
    NodePlace place = NodePlace(uvec3(0u), 0u);
    if (number < params.node_count)
    {
        matter = matterOf(number);
        place = unpackPlace(params.places.data[number]);
    }
    uint shift = 6u * (params.level_count - 1u - place.level); // log2 of the voxels of a cell
    for (uvec2 rest = matter; isAny(rest);)
    {
        uint first = firstCell(rest);
        uvec2 unit = unitAround(first, matter);
        rest &= ~unit;
        uint label = unitNumber(number, first);
        uint root = params.labels.data[label];
        uint cells = countOf(unit);
        if (root == label)
            params.sizes.data[root].voxel = (4u * place.cell + cellNumbered(first)) << (shift / 3u);
        // Most threads have a unit of one and the same component.
        if (subgroupAllEqual(root) && subgroupAllEqual(shift))
        {
            cells = subgroupAdd(cells);
            root = subgroupElect() ? root : ~0u;
        }
        uvec2 size = uvec2(shift < 32u ? cells << shift : 0u,
                           shift == 0u ? 0u : shift < 32u ? cells >> (32u - shift) : cells << (shift - 32u));
        if (root != ~0u)
            add(root, size);
    }
}
