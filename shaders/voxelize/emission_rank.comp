#version 460
// SPDX-License-Identifier: MIT
// Writes beside each word of 32 voxels how many emissive voxels stand before it.
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
    uint last = min(first + kScanItems, params.word_count);
    uint voxels = 0u;
    for (uint i = first; i < last; ++i)
        voxels += bitCount(params.words.data[i].x);
    uint total;
    uint rank = workgroupExclusiveAdd(voxels, total);
    if (first < last)
        rank += params.partials.data[workgroupIndex()];
    for (uint i = first; i < last; ++i)
    {
        params.words.data[i].y = rank;
        rank += bitCount(params.words.data[i].x);
    }
}
