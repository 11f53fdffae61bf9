#version 460
// SPDX-License-Identifier: MIT
// Copies the voxels of a box to a stamp (edit/edit.h). One thread a cell of a leaf.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditCopyParams, EDIT_COPY_CONSTANTS);
layout(local_size_x = kEditGroup) in;

#include "edit/cells.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

void main()
{
    uint number = workgroupIndex();
    uint bit = gl_LocalInvocationIndex;
    if (number >= levelCellCount(params.box, params.box.level_count - 1u))
        return;
    EditCell cell = params.cells.data[params.inner_count + number];
    uvec3 at = 4u * cellOf(params.box, params.box.level_count - 1u, number) + cellNumbered(bit);
    uint word = stampCell(number, bit);
    bool exists = hasCell(uvec2(cell.before_lo, cell.before_hi), bit) && isInDab(params.box, at);
    if (exists)
        atomicOr(params.stamp.data[stampMask(number, bit)], 1u << (bit & 31u));
    Attribute look = Attribute(0u, kNoNormal);
    uint emission = 0u;
    if (exists && kAttributes)
    {
        uint index = baseVoxel(cell, bit);
        if (index == kInteriorIndex)
            look = interiorLook(params.node_attributes.data[cell.rank]);
        else
            look = params.attributes.data[index];
        if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
            emission = params.emission.data[emissionIndex(params.emission_words, index)];
    }
    params.stamp.data[word] = look.color;
    params.stamp.data[word + 1u] = look.normal;
    params.stamp.data[word + 2u] = emission;
}
