#version 460
// SPDX-License-Identifier: MIT
// Puts every node of a level into the table of classes, unless an equal one is there; the slot keeps the first node of
// the class. Lock-free and exact: a taken slot stays with its class, so a thread that passes a slot passes it for good,
// and all nodes of a class stop at the same slot, in any order of threads. The slot depends on that order; the class
// does not.
#extension GL_GOOGLE_include_directive : require
#include "svdag/svdag.h"

GPU_ENTRY(ClassInsertParams, SVDAG_INSERT_CONSTANTS);
layout(local_size_x = kSvdagGroup) in;

#include "lib/dispatch.glsl"
#include "svdag/candidate.glsl"

Node loadCandidate(uint number)
{
    if (kLeaves)
        return loadNodeOf(params.nodes, uvec2_ConstPtr(0ul), number + params.reference);
    return params.nodes.data[number];
}

// The mask of the surface in a leaf of a filled octree.
uvec2 surfaceMask(uint number)
{
    return nodeMask(params.nodes, number + params.reference + params.surface);
}

// Compares the children of inner nodes. equal: their masks are equal.
bool haveEqualChildren(Node a, Node b, bool equal)
{
    uint_ConstPtr classes = uint_ConstPtr(uint64_t(params.classes));
    uint count = equal ? childCount(a) : 0u;
    equal = equal && childCount(b) == count; // one of them may be full
    for (uint i = 0u; equal && i < count; i += 4u)
    {
        uvec4 four = fourOf(count, i);
        equal = loadFour(classes, childrenAt(a, params.nodes, four) - params.child_reference) ==
                loadFour(classes, childrenAt(b, params.nodes, four) - params.child_reference);
    }
    return equal;
}

void main()
{
    uint index = threadIndex();
    if (index >= params.node_count)
        return;
    uint self = params.first_node + index;
    Node node = loadCandidate(self);
    uvec2 surface = kLeaves && kFilled ? surfaceMask(self) : uvec2(0u);
    uvec2 hash = kLeaves ? uvec2(hashMask(node.mask_lo, node.mask_hi), 0u) : params.hashes.data[index];
    hash.x ^= kLeaves && kFilled ? hashMask(~surface.x, surface.y) : 0u;
    uint slot = hash.x & params.slot_mask;
    uint first = self; // of the class
    bool searching = true;
    for (uint probe = 0u; searching && probe < kClassProbesMax; ++probe)
    {
        first = params.table.data[params.first_slot + slot];
        if (first == kEmptySlot)
        {
            first = atomicCompSwap(params.table.data[params.first_slot + slot], kEmptySlot, self);
            first = first == kEmptySlot ? self : first;
        }
        Node other = loadCandidate(first);
        bool equal = other.mask_lo == node.mask_lo && other.mask_hi == node.mask_hi;
        if (kLeaves && kFilled)
            equal = equal && surfaceMask(first) == surface;
        if (!kLeaves)
        {
            equal = equal && params.hashes.data[first - params.first_node] == hash;
            equal = haveEqualChildren(node, other, equal && first != self) || first == self;
        }
        searching = !equal;
        slot = searching ? (slot + 1u) & params.slot_mask : slot;
    }
    if (searching)
    {
        atomicAdd(params.sizes.data[0].overflow_counts[params.level], 1u);
        slot = (slot - 1u) & params.slot_mask; // joins some class, so that there are no more classes than slots
    }
    else if (self < first)
    {
        atomicMin(params.table.data[params.first_slot + slot], self);
    }
    params.classes.data[self] = params.first_slot + slot;
}
