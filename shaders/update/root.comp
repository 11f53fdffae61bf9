#version 460
// SPDX-License-Identifier: MIT
// Begins the overlay: merges the roots, and sets the size of the work on the next level. If no layer has any voxels,
// the overlay is a copy of the base tree's root. If the touched nodes found no room, there is no overlay.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

layout(constant_id = 0) const bool kAttributes = false;
layout(constant_id = 1) const bool kRanks = false;

layout(local_size_x = kArgsGroup) in;
layout(push_constant, scalar) uniform Push
{
    RootParams params;
};

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    uint failed = params.status.data[0].failed;
    failed |= params.counters.data[0].overflow_count != 0u ? kFailedTable : 0u;
    LevelRange range = params.ranges.data[params.level_count - 1u];
    bool touched = failed == 0u && range.count == 1u;
    bool is_leaf = params.level_count == 1u;
    Node root = params.nodes.data[params.base_root];
    uint child_nodes = 0u;
    uint voxels = 0u;
    if (touched)
    {
        uint entry = params.items.data[range.first].entry;
        BrickEntry brick = params.bricks.data[entry];
        root.mask_lo |= brick.mask_lo;
        root.mask_hi |= brick.mask_hi;
        root.base_lo = is_leaf ? params.first_voxel : params.first_node + 1u;
        root.base_hi = root.base_lo + bitCount(root.mask_lo);
        params.touched.data[entry] = TouchedNode(params.first_node, params.base_root);
        uint children = bitCount(root.mask_lo) + bitCount(root.mask_hi);
        child_nodes = is_leaf ? 0u : children;
        voxels = is_leaf ? children : 0u;
    }
    failed |= 1u + child_nodes > params.node_capacity ? kFailedNodes : 0u;
    failed |= voxels > params.voxel_capacity ? kFailedVoxels : 0u;
    bool continues = touched && failed == 0u;
    if (failed == 0u)
    {
        params.nodes.data[params.first_node] = root;
        if (kAttributes)
            params.node_attributes.data[params.first_node + params.attribute_offset] =
                params.node_attributes.data[params.base_root + params.attribute_offset];
        if (kRanks)
            params.ranks.data[params.first_node] = BeforeChild(0u, 0u);
    }
    params.levels.data[0] = OverlayLevel(params.first_node, 1u);
    if (!is_leaf)
        params.levels.data[1] = OverlayLevel(params.first_node + 1u, continues ? child_nodes : 0u);
    params.status.data[0].failed = failed;
    params.status.data[0].node_count = 1u + child_nodes;
    params.status.data[0].voxel_count = voxels;
    params.args.data[kArgsExpand] = DispatchArgs(continues && !is_leaf ? 1u : 0u, 1u, 1u);
    params.args.data[kArgsAssign] = DispatchArgs(0u, 1u, 1u);
    params.args.data[kArgsMerge] = DispatchArgs(continues && is_leaf ? 1u : 0u, 1u, 1u);
}
