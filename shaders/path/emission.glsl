// SPDX-License-Identifier: MIT
// The light of voxels. The includer includes shared/tree_table.h before and declares params.tree.
#ifndef ZVO_SHADERS_PATH_EMISSION_GLSL
#define ZVO_SHADERS_PATH_EMISSION_GLSL

#include "lib/color.glsl"
#include "lib/emission.glsl"
#include "shared/gpu.h"

// The radiance of an emissive voxel, by the index of its attributes.
vec3 emissionOf(uint voxel)
{
    uint index = emissionIndex(uvec2_ConstPtr(uint64_t(params.tree.data[0].emission_words)), voxel);
    return params.tree.data[0].emission_scale * decodeRgb9e5(params.tree.data[0].emission.data[index]);
}

#endif
