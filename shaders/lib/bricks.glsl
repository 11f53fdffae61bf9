// SPDX-License-Identifier: MIT
// Lock-free find and insert in the brick table (shared/bricks.h). Linear probing; entries are never removed.
#include "shared/bricks.h"

const uint kNoEntry = ~0u;

// First entry to look at. Keys that differ in the lowest bits only stand side by side.
uint brickHome(uint key, uint mask)
{
    uint run = (key >> kBrickRunLog2) * 2654435761u; // Knuth's multiplicative hash
    run ^= run >> 15;
    return ((run << kBrickRunLog2) | (key & ((1u << kBrickRunLog2) - 1u))) & mask;
}

// The entry of key, claimed when there is none. start: where to begin looking. kNoEntry when the probes ran out.
// claimed: this call put the key there.
uint brickFindOrInsert(BrickEntry_Ptr bricks, uint mask, uint key, uint start, out bool claimed)
{
    uint entry = start;
    uint found = 0u;
    bool searching = true;
    claimed = false;
    for (uint probe = 0u; searching && probe < kBrickProbesMax; ++probe)
    {
        found = bricks.data[entry].key;
        if (found == 0u)
        {
            found = atomicCompSwap(bricks.data[entry].key, 0u, key);
            claimed = found == 0u;
        }
        searching = !claimed && found != key;
        entry = searching ? (entry + 1u) & mask : entry;
    }
    return searching ? kNoEntry : entry;
}

// The entry of a key that an earlier dispatch inserted, or kNoEntry.
uint brickFind(BrickEntry_ConstPtr bricks, uint mask, uint key)
{
    uint entry = brickHome(key, mask);
    uint found = bricks.data[entry].key;
    for (uint probe = 0u; found != key && found != 0u && probe < kBrickProbesMax; ++probe)
    {
        entry = (entry + 1u) & mask;
        found = bricks.data[entry].key;
    }
    return found == key ? entry : kNoEntry;
}
