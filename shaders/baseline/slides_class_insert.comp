#version 460
// SPDX-License-Identifier: MIT
// Finds the class of each candidate in the table, or adds it. The slides' kernel locks a slot, writes the node, and
// releases the slot, while others wait; Vulkan does not promise that such a wait ends. Here all candidates were written
// by an earlier pass, so a slot is taken by one compare-and-swap of a candidate's number, and what is in it can be
// compared at once. A slot that is taken stays with its class.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesClassParams, BASELINE_SLIDES_CLASS_INSERT_CONSTANTS);

#include "baseline/slides_class.glsl"
#include "lib/dispatch.glsl"

const uint kComparedWords = 9u; // mask and children: prefix sums follow from them

// The finalizer of MurmurHash3 (A. Appleby, 2011).
uint mixBits(uint h)
{
    h ^= h >> 16;
    h *= 2246822507u;
    h ^= h >> 13;
    h *= 3266489909u;
    return h ^ (h >> 16);
}

void main()
{
    uint self = threadIndex();
    if (self >= params.candidate_count)
        return;
    uint node[kComparedWords];
    uint hash = 0u;
    [[unroll]] for (uint i = 0u; i < kComparedWords; ++i)
    {
        node[i] = params.candidates.data[self * kNodeWords + i];
        hash = mixBits(hash * 31u + node[i]);
    }
    uint slot = hash & params.slot_mask;
    uint holder = self;
    bool searching = true;
    for (uint probe = 0u; searching && probe < kSlidesProbesMax; ++probe)
    {
        holder = params.table.data[slot];
        if (holder == kSlidesFreeSlot)
        {
            holder = atomicCompSwap(params.table.data[slot], kSlidesFreeSlot, self);
            holder = holder == kSlidesFreeSlot ? self : holder;
        }
        bool equal = true;
        [[unroll]] for (uint i = 0u; i < kComparedWords; ++i)
            equal = equal && params.candidates.data[holder * kNodeWords + i] == node[i];
        searching = !equal;
        slot = searching ? (slot + 1u) & params.slot_mask : slot;
    }
    if (searching)
    {
        atomicAdd(params.counters.data[0].overflow_count, 1u);
        slot = (slot - 1u) & params.slot_mask; // joins some class
    }
    else if (self < holder)
    {
        atomicMin(params.table.data[slot], self);
    }
    params.slots.data[self] = slot;
}
