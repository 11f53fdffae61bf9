#version 460
// SPDX-License-Identifier: MIT
// Writes the attributes of the voxels of changed leaves: as before the dab, or as the brush asks.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditVoxelsParams, EDIT_VOXELS_CONSTANTS);

#include "edit/voxels.glsl"
#include "edit/cells.glsl"
#include "lib/normal.glsl"

Attribute stampLook(EditVoxel voxel)
{
    uint word = stampCell(voxel.leaf, voxel.bit);
    uint kept = kEmits ? ~0u : ~(kAttributeEmissive << 24);
    return Attribute(params.stamp.data[word] & kept, params.stamp.data[word + 1u]);
}

// The look of a voxel that the brush makes.
Attribute madeLook(uvec3 cell)
{
    ivec3 normal = brushNormal(params.brush, cell);
    return Attribute(params.brush.color, normal == ivec3(0) ? kNoNormal : encodeNormal(normal));
}

// The look of a voxel that was there before.
Attribute keptLook(EditVoxel voxel)
{
    Attribute before = params.attributes.data[voxel.base];
    return Attribute(isPainted(voxel) ? params.brush.color : before.color, before.normal);
}

void main()
{
    EditVoxel voxel = editVoxel();
    if (!voxel.exists)
        return;
    Attribute look;
    if (isStamped(voxel))
        look = stampLook(voxel);
    else if (voxel.base == kNoEditNode)
        look = madeLook(voxel.cell);
    else
        look = keptLook(voxel);
    params.attributes.data[voxel.index] = look;
    if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
        atomicOr(params.emission_words.data[voxel.index >> 5].x, 1u << (voxel.index & 31u));
}
