#version 460
// SPDX-License-Identifier: MIT
// Writes the attributes of the voxels of changed leaves: as before the dab, or as the brush asks.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditVoxelsParams, EDIT_VOXELS_CONSTANTS);

#include "edit/voxels.glsl"
#include "edit/cells.glsl"
#include "lib/normal.glsl"

void main()
{
    EditVoxel voxel = editVoxel();
    if (!voxel.exists)
        return;
    bool is_new = voxel.base == kNoEditNode;
    Attribute look = Attribute(params.brush.color, 0u);
    if (is_new)
        look.normal = encodeNormal(brushNormal(params.brush, voxel.cell));
    else
    {
        Attribute before = params.attributes.data[voxel.base];
        bool painted = params.brush.action == kBrushPaint && isUnderBrush(params.brush, voxel.cell);
        look = Attribute(painted ? params.brush.color : before.color, before.normal);
    }
    params.attributes.data[voxel.index] = look;
    if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
        atomicOr(params.emission_words.data[voxel.index >> 5].x, 1u << (voxel.index & 31u));
}
