#version 460
// SPDX-License-Identifier: MIT
// Finds which children of each node of a level have emissive voxels below: a thread for each cell.
#extension GL_GOOGLE_include_directive : require
#include "light/light_tree.h"

GPU_ENTRY(LightExpandParams, LIGHT_EXPAND_CONSTANTS);
layout(local_size_x = kLightGroup) in;

#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/node.glsl"
#include "lib/ranks.glsl"
#include "light/item.glsl"

shared uint s_masks[2];

// By the flags of the child's attribute, the OR of those of its voxels.
bool hasEmissiveFlag(RankedNode child, bool direct)
{
    uint index = kRanked && direct ? child.node + params.tree.data[0].attribute_offset : child.rank;
    return ((params.tree.data[0].node_attributes.data[index].color >> 24) & kAttributeEmissive) != 0u;
}

// By the voxels below the child, which follow each other in a tree without overlays.
bool hasEmissiveVoxels(RankedNode child)
{
    uint first = outermostVoxel(child, params.level + 1u, true);
    uint last = outermostVoxel(child, params.level + 1u, false);
    uvec2_ConstPtr words = uvec2_ConstPtr(uint64_t(params.tree.data[0].emission_words));
    return emissionIndex(words, first) != emissionIndex(words, last) + (isEmissive(words, last) ? 1u : 0u);
}

void main()
{
    LightLevel level = params.levels.data[params.level];
    uint item = workgroupIndex();
    if (item >= level.count)
        return;
    uint cell = gl_LocalInvocationIndex;
    if (cell < 2u)
        s_masks[cell] = 0u;
    barrier();
    LightItem at = params.items.data[level.first + item];
    if (hasChild(loadNode(at.node), cell))
    {
        bool direct;
        RankedNode child =
            childOf(RankedNode(at.node, at.voxels, at.rank), cell, params.level + 2u == kNodeLevels, direct);
        if (kFlags ? hasEmissiveFlag(child, direct) : hasEmissiveVoxels(child))
            atomicOr(s_masks[cell >> 5], 1u << (cell & 31u));
    }
    barrier();
    if (cell == 0u)
        params.nodes.data[level.first + item].mask_lo = s_masks[0];
    if (cell == 1u)
        params.nodes.data[level.first + item].mask_hi = s_masks[1];
}
