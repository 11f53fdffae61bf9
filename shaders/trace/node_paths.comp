#version 460
// SPDX-License-Identifier: MIT
// Writes where rays may begin: for each cell of a grid over the root cube, the nodes that contain it
// (trace/node_paths.h).
#extension GL_GOOGLE_include_directive : require
#include "trace/node_paths.h"

GPU_ENTRY(NodePathsParams, TRACE_NODE_PATHS_CONSTANTS);
layout(local_size_x = kPathsGroup) in;

#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"

// The nodes of a path as rays take them; 0 for those that do not exist.
uint64_t packPath(uint path[kPathLevels], uint before_children)
{
    uint node1 = path[0] - before_children;
    bool has1 = path[0] != 0u && node1 - 1u < (1u << kPathLevel1Bits) - 1u;
    bool relative = path[1] >= 1u << kPathLevel2Bits;
    uint node2 = relative ? path[1] - before_children : path[1];
    bool has2 = has1 && node2 - 1u < (1u << kPathLevel2Bits) - 1u;
    uint upper = (node2 << kPathLevel2Shift) | (relative ? 1u << kPathRelativeShift : 0u);
    return packUint2x32(uvec2((has1 ? node1 : 0u) | (has2 ? upper : 0u), has2 ? path[2] : 0u));
}

void main()
{
    uint i = threadIndex();
    if (i >= kPathCells * kPathCells * kPathCells)
        return;
    uvec3 cell = uvec3(i, i >> kPathCellBits, i >> (2u * kPathCellBits)) & (kPathCells - 1u);
    uint path[kPathLevels];
    uint node = 0u;
    bool present = true;
    for (uint level = 0u; level < kPathLevels; ++level)
    {
        uint c = cellInBlock(cell >> (2u * (kPathLevels - 1u - level)));
        Node n = loadInner(params.octree, present ? node : 0u);
        present = present && hasChild(n, c);
        node = childIndex(n, c);
        if (kEntriesPerWord != 0u && present)
            node = listedChild(params.octree, node, kEntriesPerWord);
        path[level] = present ? node : 0u;
    }
    uint first_child = params.octree.data[0].base_lo;
    bool listed = kEntriesPerWord != 0u && (first_child & kChildList) != 0u;
    params.paths.data[i] = packPath(path, listed ? 0u : first_child - 1u);
}
