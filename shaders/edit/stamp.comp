#version 460
// SPDX-License-Identifier: MIT
// Copies the voxels of another octree, moved by whole voxels, to a stamp (edit/edit.h). One thread a cell of a leaf.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditStampParams, EDIT_STAMP_CONSTANTS);
layout(local_size_x = kEditGroup) in;

#include "edit/cells.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/morton.glsl"

// The leaf around a voxel of the octree, or kNoEditNode if there is no such voxel. around: the lowest node around it
// that is not full.
uint leafAround(uvec3 voxel, out uint around)
{
    uint node = 0u;
    around = 0u;
    bool exists = all(lessThan(voxel, uvec3(1u << (2u * kNodeLevels))));
    for (uint level = 0u; exists && level < kNodeLevels; ++level)
    {
        uint child = cellInBlock(voxel >> (2u * (kNodeLevels - 1u - level)));
        exists = hasCell(nodeMask(params.nodes, node), child);
        around = isFullNode(node) ? around : node;
        if (exists && level + 1u < kNodeLevels)
            node = childIndex(loadInner(params.nodes, node), child);
    }
    return exists ? node : kNoEditNode;
}

void main()
{
    uint number = workgroupIndex();
    uint bit = gl_LocalInvocationIndex;
    if (number >= levelCellCount(params.box, params.box.level_count - 1u))
        return;
    uvec3 cell = 4u * cellOf(params.box, params.box.level_count - 1u, number) + cellNumbered(bit);
    uvec3 voxel = uvec3(ivec3(cell) - params.offset); // those below 0 are far away
    if (!isInDab(params.box, cell))
        return;
    uint around;
    uint leaf = leafAround(voxel, around);
    if (leaf == kNoEditNode)
        return;
    Attribute look = Attribute(0u, kNoNormal);
    uint emission = 0u;
    if (kAttributes)
    {
        Node surface = loadSurfaceOf(params.nodes, params.leaf_groups, leaf);
        uint index = childIndex(surface, cellInBlock(voxel));
        if (hasChild(surface, cellInBlock(voxel)))
            look = params.attributes.data[index];
        else
            look = interiorLook(params.node_attributes.data[nodeIndexOf(params.leaf_groups, around)]);
        if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
            emission = params.emission.data[emissionIndex(params.emission_words, index)];
    }
    atomicOr(params.stamp.data[stampMask(number, bit)], 1u << (bit & 31u));
    uint word = stampCell(number, bit);
    params.stamp.data[word] = look.color;
    params.stamp.data[word + 1u] = look.normal;
    params.stamp.data[word + 2u] = emission;
}
