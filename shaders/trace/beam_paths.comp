#version 460
// SPDX-License-Identifier: MIT
// Where rays may begin their descent: for each cell of a grid over the root cube, the nodes that contain it.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"

layout(local_size_x = kBeamGroup) in;
layout(push_constant, scalar) uniform Push
{
    BeamPathsParams params;
};

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
        Node n = params.octree.data[present ? node : 0u];
        uint mask = c < 32u ? n.mask_lo : n.mask_hi;
        present = present && ((mask >> (c & 31u)) & 1u) != 0u;
        node = (c < 32u ? n.base_lo : n.base_hi) + bitCount(mask & ((1u << (c & 31u)) - 1u));
        path[level] = present ? node : 0u;
    }
    params.paths.data[i] = packUint2x32(uvec2(path[0] | (path[1] << kPathLevel2Shift), path[2]));
}
