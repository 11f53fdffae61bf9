#version 460
// SPDX-License-Identifier: MIT
// Exclusive prefix sum in place, by one workgroup that walks over the values.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"

GPU_ENTRY(ScanParams, GPU_NO_CONSTANTS);
layout(local_size_x = kScanGroup) in;

#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"

void main()
{
    uint carry = 0u;
    for (uint first = 0u; first < params.count; first += kScanGroup)
    {
        uint i = first + gl_LocalInvocationIndex;
        uint value = i < params.count ? params.values.data[i] : 0u;
        uint total;
        uint before = workgroupExclusiveAdd(value, total);
        if (i < params.count)
            params.values.data[i] = carry + before;
        carry += total;
    }
    if (gl_LocalInvocationIndex == 0u)
        params.total.data[0] = carry;
}
