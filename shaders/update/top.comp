#version 460
// SPDX-License-Identifier: MIT
// Begins the overlay in one workgroup: merges the roots, and writes the root's children, as update/expand and
// update/assign do. If no layer has any voxels, the overlay is a copy of the base tree's root. If the
// touched nodes found no room, there is no overlay.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"

GPU_ENTRY(TopParams, UPDATE_TOP_CONSTANTS);
layout(local_size_x = kRootGroup) in;

#define SCAN_GROUP kRootGroup
#include "lib/scan.glsl"

const bool kRanks = kEntriesPerWord != 0u && kAttributes;

#include "update/expand.glsl"

shared bool s_continues;

// By one thread. Returns whether there are levels below the root to write.
bool mergeRoot(uint level_count)
{
    uint failed = params.state.data[0].status.failed;
    failed |= params.counters.data[0].overflow_count != 0u ? kFailedTable : 0u;
    LevelRange range = params.ranges.data[level_count - 1u];
    bool touched = failed == 0u && range.count == 1u;
    bool is_leaf = level_count == 1u;
    Node root = params.nodes.data[params.base_root];
    uint children = 0u;
    if (touched)
    {
        uint entry = params.items.data[range.first].entry;
        BrickEntry brick = params.bricks.data[entry];
        uvec2 mask = mergedMask(entry, brick, uvec2(root.mask_lo, root.mask_hi));
        root.mask_lo = mask.x;
        root.mask_hi = mask.y;
        root.base_lo = is_leaf ? params.first_voxel : params.first_node + 1u;
        root.base_hi = root.base_lo + bitCount(root.mask_lo);
        params.touched.data[entry] = TouchedNode(params.first_node, params.base_root);
        children = bitCount(root.mask_lo) + bitCount(root.mask_hi);
    }
    if (failed == 0u)
    {
        params.nodes.data[params.first_node] = root;
        if (kAttributes)
            params.node_attributes.data[params.first_node + params.attribute_offset] =
                params.node_attributes.data[params.base_root + params.attribute_offset];
        if (kRanks)
            params.ranks.data[params.first_node] = BeforeChild(0u, 0u);
    }
    params.state.data[0].status.failed = failed;
    params.state.data[0].status.node_count = 1u;
    OverlayLevel span = OverlayLevel(params.first_node, 1u);
    params.state.data[0].levels[0] = span;
    return sizeNextLevel(0u, span, children, false) && touched && !is_leaf;
}

void main()
{
    uint level_count = params.state.data[0].level_count;
    if (gl_LocalInvocationIndex == 0u)
        s_continues = mergeRoot(level_count);
    memoryBarrierBuffer();
    memoryBarrierShared();
    barrier();
    if (!s_continues)
        return;
    OverlayLevel span = params.state.data[0].levels[1];
    bool are_leaves = level_count == kRootLevels;
    uint child;
    uint count = expandChild(params.items.data[params.ranges.data[level_count - 1u].first].entry,
                             gl_LocalInvocationIndex, kEntriesPerWord != 0u && are_leaves, child);
    uint children;
    uint base = workgroupExclusiveAdd(count, children); // the root's children stand in the order of its cells
    if (gl_LocalInvocationIndex == 0u)
        s_continues = sizeNextLevel(1u, span, children, false);
    memoryBarrierShared();
    barrier();
    base += are_leaves ? params.first_voxel : span.first_node + span.node_count;
    if (s_continues && count != 0u)
        setBase(child, base);
}
