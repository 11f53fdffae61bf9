#version 460
// SPDX-License-Identifier: MIT
// First pass of the beam grid: sets the cells that touch an occupied part of the octree, or have a neighbour that does,
// and writes the nodes of level 2, and the masks of levels 1 and 2.
#extension GL_GOOGLE_include_directive : require
#include "trace/beam.h"
#include "lib/dispatch.glsl"

layout(constant_id = 0) const uint kEntriesPerWord = 0u; // of lists; 0: there are none
layout(constant_id = 1) const uint kLevels = 3u;         // of the octree's nodes that are looked at

layout(local_size_x = kBeamGroup) in;
layout(push_constant, scalar) uniform Push
{
    BeamNodesParams params;
};

#include "trace/dilate.glsl"
#include "trace/siblings.glsl"

void main()
{
    uint parent = workgroupIndex();
    uint morton = threadIndex();
    BeamLevel level = BeamLevel(kLevels - 1u, 1 << (2u * kLevels), 1, int(kBeamCells) - 2);
    uvec2 mask = dilatedCells(params.octree, level, mortonDecode(parent));
    params.masks.data[morton] = packUint2x32(mask);
    uvec2 siblings = writeSiblings(params.nodes, kBeamFirst2 + parent * kBeamGroup, mask,
                                   kBeamFirst3 + morton * kBeamGroup);
    if (gl_LocalInvocationIndex == 0u)
        params.masks.data[kBeamBlocks + parent] = packUint2x32(siblings);
}
