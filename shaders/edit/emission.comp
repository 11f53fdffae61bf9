#version 460
// SPDX-License-Identifier: MIT
// Writes the emission of the emissive voxels of changed leaves: as before the dab, as the brush asks, or that of a
// stamp.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditVoxelsParams, EDIT_EMISSION_CONSTANTS);

#include "edit/cells.glsl"
#include "edit/voxels.glsl"
#include "lib/emission.glsl"

void main()
{
    EditVoxel voxel = editVoxel();
    if (!voxel.exists || ((params.attributes.data[voxel.index].color >> 24) & kAttributeEmissive) == 0u)
        return;
    uvec2_ConstPtr words = uvec2_ConstPtr(uint64_t(params.emission_words));
    uint value = params.brush.emission;
    if (isStamped(voxel))
        value = params.stamp.data[stampCell(voxel.leaf, voxel.bit) + 2u];
    else if (voxel.base != kNoEditNode && !isPainted(voxel))
        value = params.emission.data[emissionIndex(words, voxel.base)];
    params.emission.data[emissionIndex(words, voxel.index)] = value;
}
