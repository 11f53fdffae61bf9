// SPDX-License-Identifier: MIT
// Lists of the touched nodes of each level, and the sizes of the passes over them.
// Needs the parameters items, ranges, args, level_count and max_groups_x of update/insert, and what lib/brick_keys.glsl
// needs.
#ifndef ZVO_SHADERS_UPDATE_TOUCHED_GLSL
#define ZVO_SHADERS_UPDATE_TOUCHED_GLSL

#include "lib/brick_keys.glsl"
#include "octree/nodes.glsl"
#include "update/update.h"

// The level of a node, counted from the root.
uint levelOfKey(uvec2 key)
{
    uvec2 code = kWideKeys ? key & ~kBrickKeyTag : uvec2(key.x, 0u);
    return uint(code.y != 0u ? int(kBrickKeyBits) + findMSB(code.y) : findMSB(code.x)) / 6u;
}

void listTouched(uint entry, uint height)
{
    uint place = params.ranges.data[height].first + atomicAdd(params.ranges.data[height].count, 1u);
    params.items.data[place] = WorkItem(entry, 0u);
}

// By one thread, when all nodes are listed. Returns their number.
uint sizeLevels()
{
    uint node_count = 0u;
    for (uint height = 0u; height < params.level_count; ++height)
    {
        uint count = atomicAdd(params.ranges.data[height].count, 0u);
        params.args.data[height] = nodeArgs(count, params.max_groups_x);
        node_count += count;
    }
    return node_count;
}

#endif
