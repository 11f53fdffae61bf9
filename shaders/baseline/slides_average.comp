#version 460
// SPDX-License-Identifier: MIT
// The attribute of each voxel: the mean of its fragments, in integers. Fragments beyond kSlidesVoxelFragments are left
// out and noted.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesAverageParams, GPU_NO_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"

#define COLOR_BINDING 0
#include "voxelize/resolve.glsl"

void addFragment(inout VoxelSums sums, SlidesFragment fragment)
{
    const uint mask = (1u << 16) - 1u;
    sums.red += fragment.red_green & mask;
    sums.green += fragment.red_green >> 16;
    sums.blue += fragment.blue_x & mask;
    sums.normal_x += fragment.blue_x >> 16;
    sums.normal_y += fragment.y_z & mask;
    sums.normal_z += fragment.y_z >> 16;
    ++sums.fragments;
}

void main()
{
    uint voxel = threadIndex();
    if (voxel >= params.voxel_count)
        return;
    uint first = params.firsts.data[voxel];
    uint end = voxel + 1u < params.voxel_count ? params.firsts.data[voxel + 1u] : params.fragment_count;
    if (end - first > kSlidesVoxelFragments)
        atomicAdd(params.counters.data[0].capped_voxels, 1u);
    end = min(end, first + kSlidesVoxelFragments);
    VoxelSums sums = VoxelSums(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    for (uint i = first; i < end; ++i)
        addFragment(sums, params.fragments.data[params.indices.data[i]]);
    params.attributes.data[voxel] = resolveSums(params.scene, sums, 0u, 0u);
}
