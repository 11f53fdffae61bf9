// SPDX-License-Identifier: MIT
// A node gets its number: its parent's child base plus its rank among the parent's children. Until its own child base
// is known, base_hi of the node holds its entry in the brick table.
// Needs the constant kWideKeys, params.bricks and params.nodes.
#ifndef ZVO_SHADERS_OCTREE_PLACE_GLSL
#define ZVO_SHADERS_OCTREE_PLACE_GLSL

#include "lib/brick_keys.glsl"
#include "lib/node.glsl"
#include "shared/bricks.h"
#include "shared/octree.h"

// Returns the number.
uint placeNode(WorkItem item, bool is_root, out uint children)
{
    BrickEntry brick = params.bricks.data[item.entry];
    uint node = 0u;
    if (!is_root)
        node = childIndex(params.nodes.data[nodeOf(params.bricks.data[item.parent_entry])], brick.key & 63u);
    params.nodes.data[node] = Node(brick.mask_lo, 0u, brick.mask_hi, item.entry);
    if (kWideKeys)
        params.bricks.data[item.entry].mask_lo = node;
    else
        params.bricks.data[item.entry].base = node;
    children = bitCount(brick.mask_lo) + bitCount(brick.mask_hi);
    return node;
}

#endif
