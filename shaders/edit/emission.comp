#version 460
// SPDX-License-Identifier: MIT
// Writes the emission of the emissive voxels of changed leaves: as before the dab, or as the brush asks.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditVoxelsParams, GPU_NO_CONSTANTS);

#include "edit/cells.glsl"
#include "edit/voxels.glsl"
#include "lib/emission.glsl"

void main()
{
    EditVoxel voxel = editVoxel();
    if (!voxel.exists || ((params.attributes.data[voxel.index].color >> 24) & kAttributeEmissive) == 0u)
        return;
    uvec2_ConstPtr words = uvec2_ConstPtr(uint64_t(params.emission_words));
    bool is_new = voxel.base == kNoEditNode;
    uint emission = params.brush.emission;
    if (!is_new && (params.brush.action != kBrushPaint || !isUnderBrush(params.brush, voxel.cell)))
        emission = params.emission.data[emissionIndex(words, voxel.base)];
    params.emission.data[emissionIndex(words, voxel.index)] = emission;
}
