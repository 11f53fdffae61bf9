#version 460
// SPDX-License-Identifier: MIT
// Exclusive prefix sum over the blocks of a level's nodes, by one workgroup that walks over them. Then it sizes the
// next level, or the leaves' voxels: nothing if they find no room.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#include "lib/dispatch_args.glsl"
#define SCAN_GROUP kScanGroup
#include "lib/scan.glsl"

layout(local_size_x = kScanGroup) in;
layout(push_constant, scalar) uniform Push
{
    OverlayScanParams params;
};

void main()
{
    OverlayLevel level = params.levels.data[params.level];
    uint block_count = (level.node_count + kScanBlock - 1u) / kScanBlock;
    uint carry = 0u;
    bool wrapped = false; // past 2^32
    for (uint first = 0u; first < block_count; first += kScanGroup)
    {
        uint i = first + gl_LocalInvocationIndex;
        uint value = i < block_count ? params.partials.data[params.first_partial + i] : 0u;
        uint total;
        uint before = workgroupExclusiveAdd(value, total);
        if (i < block_count)
            params.partials.data[params.first_partial + i] = carry + before;
        wrapped = wrapped || carry + total < carry;
        carry += total;
    }
    if (gl_LocalInvocationIndex != 0u)
        return;
    wrapped = wrapped || params.status.data[0].node_count + carry < carry;
    bool are_leaves = params.level + 1u == params.level_count;
    uint node_count = params.status.data[0].node_count + (are_leaves ? 0u : carry);
    uint voxel_count = are_leaves ? carry : 0u;
    uint failed = params.status.data[0].failed |
                  (node_count > params.node_capacity || (wrapped && !are_leaves) ? kFailedNodes : 0u) |
                  (voxel_count > params.voxel_capacity || (wrapped && are_leaves) ? kFailedVoxels : 0u);
    bool continues = failed == 0u;
    params.status.data[0].failed = failed;
    params.status.data[0].node_count = node_count;
    params.status.data[0].voxel_count = voxel_count;
    uint touched = continues ? params.ranges.data[params.level_count - 1u - params.level].count : 0u; // of this level
    if (are_leaves)
    {
        const uint leaves_per_group = kUpdateGroup / kMergeThreads;
        params.args.data[kArgsMerge] =
            foldedArgs((touched + leaves_per_group - 1u) / leaves_per_group, params.max_groups_x);
    }
    else
    {
        params.levels.data[params.level + 1u] =
            OverlayLevel(level.first_node + level.node_count, continues ? carry : 0u);
        params.args.data[kArgsExpand] = foldedArgs(touched, params.max_groups_x);
    }
    params.args.data[kArgsAssign] = foldedArgs(continues ? block_count : 0u, params.max_groups_x);
}
