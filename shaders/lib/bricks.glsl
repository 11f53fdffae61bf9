// SPDX-License-Identifier: MIT
// Keys, and lock-free find and insert, in the brick table (shared/bricks.h). Linear probing; entries are never removed.
// The includer defines before:
//   BRICKS_CONSTANT_ID    constant_id of kWideKeys
//
// Why wide keys need neither 64-bit atomics nor waiting. An insert takes an entry's two words in order: it writes its
// lower word where the first is 0, and goes on to the next entry if that holds another one; then it does the same with
// the upper words. A word is written at most once, so each value that a thread acts on is final: it passes an entry
// exactly if the entry's final words are not its own, and stops at the first entry whose words are. So all threads with
// the same key stop at the same entry, in any order, and the one that wrote the second word has claimed it. No entry
// stays half full: the thread that wrote the first word goes on to the second, which becomes its own, or that of
// another key with the same lower word.
#include "lib/morton.glsl"
#include "shared/bricks.h"

// The octree has more than kNarrowLevelsMax levels.
layout(constant_id = BRICKS_CONSTANT_ID) const bool kWideKeys = false;

const uint kNoEntry = ~0u;

// The key of a cell among the 4^levels cells of its level. Narrow keys are in x, with y = 0.
uvec2 brickKey(uvec3 cell, uint levels)
{
    uint marker = 6u * levels;
    if (!kWideKeys)
        return uvec2(mortonEncode(cell) | (1u << marker), 0u);
    uvec2 leading = marker < kBrickKeyBits ? uvec2(1u << marker, 0u) : uvec2(0u, 1u << (marker - kBrickKeyBits));
    return mortonEncodeWide(cell) | leading | kBrickKeyTag;
}

uvec2 parentKey(uvec2 key)
{
    if (!kWideKeys)
        return uvec2(key.x >> 6, 0u);
    uvec2 code = key & ~kBrickKeyTag;
    return uvec2((code.x >> 6) | ((code.y << (kBrickKeyBits - 6u)) & ((1u << kBrickKeyBits) - 1u)), code.y >> 6) |
           kBrickKeyTag;
}

bool isSameKey(uvec2 a, uvec2 b)
{
    return a.x == b.x && (!kWideKeys || a.y == b.y);
}

// First entry to probe. Keys that differ only in the lowest bits stand side by side.
uint brickHome(uvec2 key, uint mask)
{
    uint run = key.x >> kBrickRunLog2;
    if (kWideKeys)
        run += key.y * 2246822519u; // any odd number with as many ones as zeros
    run *= 2654435761u;             // Knuth's multiplicative hash
    run ^= run >> 15;
    return ((run << kBrickRunLog2) | (key.x & ((1u << kBrickRunLog2) - 1u))) & mask;
}

// The entry of key, which is claimed if there is none; kNoEntry if the probes ran out. claimed: this call inserted the
// key.
uint brickFindOrInsert(BrickEntry_Ptr bricks, uint mask, uvec2 key, out bool claimed)
{
    uint entry = brickHome(key, mask);
    uint found = 0u;
    bool searching = true;
    claimed = false;
    for (uint probe = 0u; searching && probe < kBrickProbesMax; ++probe)
    {
        found = bricks.data[entry].key;
        if (found == 0u)
        {
            found = atomicCompSwap(bricks.data[entry].key, 0u, key.x);
            if (kWideKeys)
                found = found == 0u ? key.x : found;
            else
                claimed = found == 0u;
        }
        if (kWideKeys && found == key.x)
        {
            found = bricks.data[entry].base;
            if (found == 0u)
            {
                found = atomicCompSwap(bricks.data[entry].base, 0u, key.y);
                claimed = found == 0u;
            }
            found = found == key.y ? key.x : 0u;
        }
        searching = !claimed && found != key.x;
        entry = searching ? (entry + 1u) & mask : entry;
    }
    return searching ? kNoEntry : entry;
}

// Sets the bit of the node with a key in its parent's mask.
void setCell(BrickEntry_Ptr bricks, uint parent, uvec2 key)
{
    uint bit = 1u << (key.x & 31u);
    if ((key.x & 32u) == 0u)
        atomicOr(bricks.data[parent].mask_lo, bit);
    else
        atomicOr(bricks.data[parent].mask_hi, bit);
}

// The entry of a key that an earlier dispatch inserted, or kNoEntry.
uint brickFind(BrickEntry_ConstPtr bricks, uint mask, uvec2 key)
{
    uint entry = brickHome(key, mask);
    uvec2 found = uvec2(bricks.data[entry].key, kWideKeys ? bricks.data[entry].base : 0u);
    for (uint probe = 0u; !isSameKey(found, key) && found.x != 0u && probe < kBrickProbesMax; ++probe)
    {
        entry = (entry + 1u) & mask;
        found = uvec2(bricks.data[entry].key, kWideKeys ? bricks.data[entry].base : 0u);
    }
    return isSameKey(found, key) ? entry : kNoEntry;
}

uvec2 keyOf(BrickEntry brick)
{
    return uvec2(brick.key, brick.base);
}

// Index of a node that octree/place has numbered.
uint nodeOf(BrickEntry brick)
{
    return kWideKeys ? brick.mask_lo : brick.base;
}
