#version 460
// SPDX-License-Identifier: MIT
// Counts the emissive voxels of each block of kScanBlock words of 32 voxels.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"
#include "octree/octree.h"

GPU_ENTRY(EmissionRankParams, GPU_NO_CONSTANTS);
layout(local_size_x = kScanGroup) in;

#define SCAN_GROUP kScanGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

void main()
{
    uint first = threadIndex() * kScanItems;
    uint voxels = 0u;
    for (uint i = first; i < min(first + kScanItems, params.word_count); ++i)
        voxels += bitCount(params.words.data[i].x);
    uint total;
    workgroupExclusiveAdd(voxels, total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kScanBlock < params.word_count)
        params.partials.data[workgroupIndex()] = total;
}
