#version 460
// SPDX-License-Identifier: MIT
// Third pass of the beam grid: writes the nodes of one level, and the masks of the level above.
#extension GL_GOOGLE_include_directive : require
#include "trace/beam.h"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"

layout(constant_id = 0) const bool kLevel2 = true; // from rows; otherwise level 1, from masks, and the root

layout(local_size_x = kBeamGroup) in;
layout(push_constant, scalar) uniform Push
{
    BeamNodesParams params;
};

shared uint s_children[2]; // mask of the parent

// The mask of a node of level 2.
uvec2 maskFromRows(uint morton)
{
    uvec3 cell = 4u * mortonDecode(morton);
    uvec2 mask = uvec2(0u);
    for (uint i = 0u; i < 16u; ++i)
    {
        uint y = i & 3u;
        uint z = i >> 2;
        uint row = uint(params.rows.data[(cell.z + z) * kBeamCells + cell.y + y] >> cell.x);
        uint at = cellInBlock(uvec3(0u, y, z)) & 31u;
        uint bits = ((row & 3u) << at) | (((row >> 2) & 3u) << (at + 8u));
        mask[z >> 1] |= bits;
    }
    return mask;
}

void main()
{
    uint child = gl_LocalInvocationIndex;
    uint parent = workgroupIndex();
    uint morton = parent * kBeamGroup + child;
    if (child < 2u)
        s_children[child] = 0u;
    barrier();
    uint64_t word = kLevel2 ? packUint2x32(maskFromRows(morton)) : params.masks.data[kBeamRows + morton];
    uvec2 mask = unpackUint2x32(word);
    uint upper = child >> 5;
    if (word != 0ul)
        atomicOr(s_children[upper], 1u << (child & 31u));
    barrier();
    uint rank = bitCount(s_children[upper] & ((1u << (child & 31u)) - 1u));
    uint slot = (kLevel2 ? kBeamFirst2 : kBeamFirst1) + parent * kBeamGroup + upper * 32u + rank;
    uint first_child = (kLevel2 ? kBeamFirst3 : kBeamFirst2) + morton * kBeamGroup;
    if (word != 0ul)
        params.nodes.data[slot] = Node(mask.x, first_child, mask.y, first_child + 32u);
    if (kLevel2)
        params.masks.data[morton] = word;
    if (kLevel2 && child == 0u)
        params.masks.data[kBeamRows + parent] = packUint2x32(uvec2(s_children[0], s_children[1]));
    if (!kLevel2 && child == 0u)
        params.nodes.data[0] = Node(s_children[0], kBeamFirst1, s_children[1], kBeamFirst1 + 32u);
}
