#version 460
// SPDX-License-Identifier: MIT
// Sets the child bases of every node of a level from the prefix sum of child counts. Where a leaf's entry in the brick
// table has room for it, the entry gets the number of the leaf's first voxel.
#extension GL_GOOGLE_include_directive : require
#include "octree/octree.h"
#define SCAN_GROUP kAssignGroup
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"
#include "octree/nodes.glsl"

layout(local_size_x = kAssignGroup) in;
layout(push_constant, scalar) uniform Push
{
    AssignParams params;
};

// The children of the nodes of all blocks before this workgroup's.
uint childrenBefore()
{
    if (params.is_scanned != 0u)
        return params.partials.data[workgroupIndex()];
    uint sum = 0u;
    for (uint i = gl_LocalInvocationIndex; i < workgroupIndex(); i += kAssignGroup)
        sum += params.partials.data[i];
    uint total;
    workgroupExclusiveAdd(sum, total);
    return total;
}

void main()
{
    if (workgroupIndex() * kScanBlock >= params.node_count)
        return;
    // Four nodes a thread, which are loaded together. Those past the end of the level are its last one.
    uint first = threadIndex() * kAssignItems;
    uvec4 indices = uvec4(first, first + 1u, first + 2u, first + 3u);
    bvec4 are_nodes = lessThan(indices, uvec4(params.node_count));
    uvec4 nodes = params.first_node + min(indices, uvec4(params.node_count - 1u));
    uvec4 masks_lo = uvec4(params.nodes.data[nodes.x].mask_lo, params.nodes.data[nodes.y].mask_lo,
                           params.nodes.data[nodes.z].mask_lo, params.nodes.data[nodes.w].mask_lo);
    uvec4 masks_hi = uvec4(params.nodes.data[nodes.x].mask_hi, params.nodes.data[nodes.y].mask_hi,
                           params.nodes.data[nodes.z].mask_hi, params.nodes.data[nodes.w].mask_hi);
    uvec4 counts = uvec4(bitCount(masks_lo) + bitCount(masks_hi)) * uvec4(are_nodes);
    uint base = params.first_child + childrenBefore();
    uint total;
    base += workgroupExclusiveAdd(counts.x + counts.y + counts.z + counts.w, total);
    uvec4 bases = base + uvec4(0u, counts.x, counts.x + counts.y, counts.x + counts.y + counts.z);
    bool tell_bricks = params.tell_bricks != 0u;
    if (are_nodes.x)
        setBase(params.nodes, params.bricks, nodes.x, masks_lo.x, bases.x, tell_bricks);
    if (are_nodes.y)
        setBase(params.nodes, params.bricks, nodes.y, masks_lo.y, bases.y, tell_bricks);
    if (are_nodes.z)
        setBase(params.nodes, params.bricks, nodes.z, masks_lo.z, bases.z, tell_bricks);
    if (are_nodes.w)
        setBase(params.nodes, params.bricks, nodes.w, masks_lo.w, bases.w, tell_bricks);
}
