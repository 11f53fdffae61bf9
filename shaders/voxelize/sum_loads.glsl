// SPDX-License-Identifier: MIT
// Loads of sums for the kernels that resolve them. The includer has a kernel's parameters as params, with sums and
// max_fragments, and defines before:
//   SUMS_BINDING    the binding of sums in the kernel's bound form (lib/bound.glsl)
#ifndef ZVO_SHADERS_VOXELIZE_SUM_LOADS_GLSL
#define ZVO_SHADERS_VOXELIZE_SUM_LOADS_GLSL

#include "lib/bound.glsl"
#include "voxelize/voxelize.h"

#ifdef BOUND
TEXELS_4(SUMS_BINDING, sums);

VoxelSums loadSums(uint i)
{
    uvec4 a = texelFetch(texels4_sums, int(2u * i));
    uvec4 b = texelFetch(texels4_sums, int(2u * i + 1u));
    return VoxelSums(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}
#else
VoxelSums loadSums(uint i)
{
    return params.sums.data[i];
}
#endif

// Notes a voxel whose fragments are too many for its sums.
void noteFragments(VoxelSums sums)
{
    if ((sums.fragments >> params.sum_shift) > kFragmentsMax)
        atomicMax(params.max_fragments.data[0], sums.fragments);
}

#endif
