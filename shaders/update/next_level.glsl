// SPDX-License-Identifier: MIT
// Sizes what follows a level of an overlay. The includer has a kernel's parameters as params, and
// lib/dispatch_args.glsl.
#ifndef ZVO_SHADERS_UPDATE_NEXT_LEVEL_GLSL
#define ZVO_SHADERS_UPDATE_NEXT_LEVEL_GLSL

#include "lib/dispatch.glsl"
#include "update/update.h"

// Sizes the level below one, or the leaves' voxels, from the number of its children, which may have wrapped around at
// 2^32: nothing if they find no room. By one thread. Returns whether they do.
bool sizeNextLevel(uint level, OverlayLevel span, uint children, bool wrapped)
{
    UpdateStatus status = params.state.data[0].status;
    DispatchArgs_Ptr args = params.state.data[0].args;
    uint level_count = params.state.data[0].level_count;
    uint max_groups_x = params.state.data[0].max_groups_x;
    wrapped = wrapped || status.node_count + children < children;
    bool are_leaves = level + 1u == level_count;
    status.node_count += are_leaves ? 0u : children;
    status.voxel_count = are_leaves ? children : 0u;
    bool too_many_nodes = status.node_count > params.state.data[0].node_capacity || (wrapped && !are_leaves);
    bool too_many_voxels = status.voxel_count > params.state.data[0].voxel_capacity || (wrapped && are_leaves);
    status.failed |= (too_many_nodes ? kFailedNodes : 0u) | (too_many_voxels ? kFailedVoxels : 0u);
    bool fits = status.failed == 0u;
    params.state.data[0].status.failed = status.failed;
    params.state.data[0].status.node_count = status.node_count;
    params.state.data[0].status.voxel_count = status.voxel_count;
    uint touched = fits ? params.ranges.data[level_count - 1u - level].count : 0u; // of this level
    if (are_leaves)
    {
        const uint leaves_per_group = kUpdateGroup / kMergeThreads;
        args.data[kArgsMerge] = foldedArgs((touched + leaves_per_group - 1u) / leaves_per_group, max_groups_x);
    }
    else
    {
        params.state.data[0].levels[level + 1u] =
            OverlayLevel(span.first_node + span.node_count, fits ? children : 0u);
        args.data[kArgsExpand] = foldedArgs(touched, max_groups_x);
    }
    uint block_count = touched == 0u ? 0u : (span.node_count + kScanBlock - 1u) / kScanBlock;
    args.data[kArgsAssign] = foldedArgs(block_count, max_groups_x);
    return fits;
}

#endif
