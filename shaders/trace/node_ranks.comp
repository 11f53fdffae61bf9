#version 460
// SPDX-License-Identifier: MIT
// Writes where the ranks of hits in a DAG begin (trace/node_paths.h), behind the nodes that trace/node_paths has
// written.
#extension GL_GOOGLE_include_directive : require
#include "trace/node_paths.h"

GPU_ENTRY(NodeRanksParams, TRACE_NODE_RANKS_CONSTANTS);
layout(local_size_x = kPathsGroup) in;

#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ranks.glsl"

void main()
{
    uint i = threadIndex();
    if (i >= kPathCells * kPathCells * kPathCells)
        return;
    uvec3 cell = uvec3(i, i >> kPathCellBits, i >> (2u * kPathCellBits)) & (kPathCells - 1u);
    RankedNode at = RankedNode(0u, 0u, 0u);
    bool present = true;
    bool in_overlay = kOverlays;
    for (uint level = 0u; level < kPathLevels; ++level)
    {
        uint c = cellInBlock(cell >> (2u * (kPathLevels - 1u - level)));
        present = present && hasChild(params.source.pool.data[at.node], c);
        if (present)
            in_overlay = in_overlay && descendInOverlay(params.source, params.overlay_ranks, c, at);
        if (present && !in_overlay && kLeaves && level + 1u == kPathLevels)
            descendToLeaf(params.source, c, false, at);
        else if (present && !in_overlay)
            descend(params.source, c, at);
    }
    uint node = at.node | (in_overlay ? kChildList : 0u);
    params.paths.data[kRankTableFirst + i] = present ? packUint2x32(uvec2(node, at.voxels)) : 0ul;
    if (kOverlays && i == 0u)
        params.paths.data[kRankTableOverlays] = uint64_t(params.overlay_ranks);
}
