#version 460
// SPDX-License-Identifier: MIT
// Copies the emission of the emissive voxels of changed leaves.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditVoxelsParams, GPU_NO_CONSTANTS);

#include "edit/voxels.glsl"
#include "lib/emission.glsl"

void main()
{
    EditVoxel voxel = editVoxel();
    if (!voxel.exists || ((params.attributes.data[voxel.index].color >> 24) & kAttributeEmissive) == 0u)
        return;
    uvec2_ConstPtr words = uvec2_ConstPtr(uint64_t(params.emission_words));
    params.emission.data[emissionIndex(words, voxel.index)] = params.emission.data[emissionIndex(words, voxel.base)];
}
