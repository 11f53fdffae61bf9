// SPDX-License-Identifier: MIT
// Which voxels emit light. The includer declares params with emission_words before.
#ifndef ZVO_SHADERS_PATH_EMITTING_VOXEL_GLSL
#define ZVO_SHADERS_PATH_EMITTING_VOXEL_GLSL

bool isEmitter(uint voxel)
{
    return ((params.emission_words.data[voxel >> 5].x >> (voxel & 31u)) & 1u) != 0u;
}

#endif
