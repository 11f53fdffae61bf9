#version 460
// SPDX-License-Identifier: MIT
// Last pass of the beam grid: writes the root and level 1 and, for octrees with at least four levels of nodes, the
// finest level. The cells of that level are a quarter as large. Below each set cell, those cells are set that touch an
// occupied cell of the octree's fourth level, or have a neighbour of their own size that does.
#extension GL_GOOGLE_include_directive : require
#include "trace/beam.h"
#include "lib/dispatch.glsl"

layout(constant_id = 0) const uint kEntriesPerWord = 0u; // of lists; 0: there are none
layout(constant_id = 1) const uint kBlocks = 1u;         // nodes of level 2 a workgroup, a power of two, at most 32

layout(local_size_x = kBeamGroup) in;
layout(push_constant, scalar) uniform Push
{
    BeamRefineParams params;
};

#include "trace/dilate.glsl"
#include "trace/siblings.glsl"

const BeamLevel kFine = BeamLevel(3u, 256, 4, 4 * int(kBeamCells) - 8);

void writeTop()
{
    uint child = gl_LocalInvocationIndex;
    uvec2 mask = unpackUint2x32(params.masks.data[kBeamBlocks + child]);
    uvec2 root = writeSiblings(params.nodes, kBeamFirst1, mask, kBeamFirst2 + child * kBeamGroup);
    if (child == 0u)
        params.nodes.data[0] = Node(root.x, kBeamFirst1, root.y, kBeamFirst1 + 32u);
}

// Writes the children of a node of level 2.
void refine(uint parent)
{
    uvec2 cells = dilatedCells(params.octree, kFine, mortonDecode(parent));
    uvec2 siblings = unpackUint2x32(params.masks.data[parent]);
    uint child = gl_LocalInvocationIndex;
    uint half_mask = child < 32u ? siblings.x : siblings.y;
    uint bit = 1u << (child & 31u);
    if ((half_mask & bit) != 0u)
        params.nodes.data[kBeamFirst3 + parent * kBeamGroup + (child & 32u) + bitCount(half_mask & (bit - 1u))] =
            Node(cells.x, 0u, cells.y, 0u);
}

void main()
{
    if (workgroupIndex() == 0u)
    {
        writeTop();
        return;
    }
    uint first = (workgroupIndex() - 1u) * kBlocks;
    if (first >= kBeamBlocks)
        return;
    uvec2 siblings = unpackUint2x32(params.masks.data[kBeamBlocks + first / 64u]);
    uint nodes = bitfieldExtract((first & 32u) == 0u ? siblings.x : siblings.y, int(first & 31u), int(kBlocks));
    if (nodes == 0u)
        return;
    do
    {
        refine(first + uint(findLSB(nodes)));
        nodes &= nodes - 1u;
    } while (kBlocks > 1u && nodes != 0u);
}
