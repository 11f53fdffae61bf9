// SPDX-License-Identifier: MIT
// Lock-free find and insert in the brick table (shared/bricks.h). Linear probing; entries are never removed.
// Needs the constant kWideKeys, params.bricks and params.brick_mask.
// BRICKS_BINDING (optional): the first of two bindings for the table in the kernel's bound form (lib/bound.glsl).
//
// Why wide keys need neither 64-bit atomics nor waiting. An insert takes an entry's two words in order: it writes its
// lower word where the first is 0, and goes on to the next entry if that holds another one; then it does the same with
// the upper words. A word is written at most once, so each value that a thread acts on is final: it passes an entry
// exactly if the entry's final words are not its own, and stops at the first entry whose words are. So all threads with
// the same key stop at the same entry, in any order, and the one that wrote the second word has claimed it. No entry
// stays half full: the thread that wrote the first word goes on to the second, which becomes its own, or that of
// another key with the same lower word.
#ifndef ZVO_SHADERS_LIB_BRICKS_GLSL
#define ZVO_SHADERS_LIB_BRICKS_GLSL

#include "lib/bound.glsl"
#include "lib/brick_keys.glsl"
#include "lib/brick_loads.glsl"
#include "shared/bricks.h"

const uint kNoEntry = ~0u;

// Words of an entry.
const uint kKeyWord = 0u;
const uint kMaskWord = 1u; // and the next one
const uint kBaseWord = 3u;
const uint kEntryWords = 4u;

// BRICK_WORD: a word of an entry, for atomics. Behind the table: of MixedVoxels.
#if defined(BOUND) && defined(BRICKS_BINDING)
STORAGE(BRICKS_BINDING + 1, uint, bricks);
#define BRICK_WORD(ENTRY, WORD) storage_bricks.data[kEntryWords * (ENTRY) + (WORD)]
#else
#define BRICK_WORD(ENTRY, WORD) uint_Ptr(uint64_t(params.bricks) + uint64_t(ENTRY) * kBrickBytes).data[WORD]
#endif

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
// key. brick: what was loaded of the entry, in which masks may be out of date.
uint brickFindOrInsert(uvec2 key, out bool claimed, out BrickEntry brick)
{
    uint entry = brickHome(key, params.brick_mask);
    bool searching = true;
    claimed = false;
    brick = BrickEntry(0u, 0u, 0u, 0u);
    for (uint probe = 0u; searching && probe < kBrickProbesMax; ++probe)
    {
        brick = loadBrick(entry);
        uint found = brick.key;
        if (found == 0u)
        {
            found = atomicCompSwap(BRICK_WORD(entry, kKeyWord), 0u, key.x);
            if (kWideKeys)
                found = found == 0u ? key.x : found;
            else
                claimed = found == 0u;
        }
        if (kWideKeys && found == key.x)
        {
            found = brick.base;
            if (found == 0u)
            {
                found = atomicCompSwap(BRICK_WORD(entry, kBaseWord), 0u, key.y);
                claimed = found == 0u;
            }
            found = found == key.y ? key.x : 0u;
        }
        searching = !claimed && found != key.x;
        entry = searching ? (entry + 1u) & params.brick_mask : entry;
    }
    return searching ? kNoEntry : entry;
}

uint brickFindOrInsert(uvec2 key, out bool claimed)
{
    BrickEntry brick;
    return brickFindOrInsert(key, claimed, brick);
}

// Sets the bit of a cell in the masks of an entry.
void setCell(uint entry, uint cell)
{
    atomicOr(BRICK_WORD(entry, kMaskWord + (cell >> 5)), 1u << (cell & 31u));
}

// The entry of a key that an earlier dispatch inserted, or kNoEntry. brick: its contents.
uint brickFind(uvec2 key, out BrickEntry brick)
{
    uint entry = brickHome(key, params.brick_mask);
    brick = loadBrick(entry);
    for (uint probe = 0u; !isSameKey(keyOf(brick), key) && brick.key != 0u && probe < kBrickProbesMax; ++probe)
    {
        entry = (entry + 1u) & params.brick_mask;
        brick = loadBrick(entry);
    }
    return isSameKey(keyOf(brick), key) ? entry : kNoEntry;
}

#endif
