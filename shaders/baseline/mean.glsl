// SPDX-License-Identifier: MIT
// The look of a node: the mean of its occupied children's. Colours are averaged as sRGB codes, normals as vectors.
#ifndef ZVO_SHADERS_BASELINE_MEAN_GLSL
#define ZVO_SHADERS_BASELINE_MEAN_GLSL

#include "baseline/pointer_octree.h"
#include "lib/arithmetic.glsl"
#include "lib/normal.glsl"

struct MeanSums
{
    uvec3 color;
    ivec3 normal;
    uint count;
};

MeanSums noSums()
{
    return MeanSums(uvec3(0u), ivec3(0), 0u);
}

void addToMean(PointerNode node, inout MeanSums sums)
{
    bool occupied = node.child != 0u;
    uvec3 color = uvec3(node.color & 255u, (node.color >> 8) & 255u, (node.color >> 16) & 255u);
    sums.color += occupied ? color : uvec3(0u);
    sums.normal += occupied ? decodeNormal(node.normal) : ivec3(0);
    sums.count += occupied ? 1u : 0u;
}

// The node above the children, whose tile begins at child.
PointerNode meanNode(MeanSums sums, uint child)
{
    uint count = max(sums.count, 1u);
    uvec3 color = divideSmall(sums.color + count / 2u, count);
    return PointerNode(child, color.r | (color.g << 8) | (color.b << 16) | kOpaqueColor, encodeNormal(sums.normal));
}

#endif
