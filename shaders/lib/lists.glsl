// SPDX-License-Identifier: MIT
// Lists of children in a pool (shared/svdag.h).
#ifndef ZVO_SHADERS_LIB_LISTS_GLSL
#define ZVO_SHADERS_LIB_LISTS_GLSL

#include "shared/svdag.h"

// The entry at a place. per_word: of all entries of the pool, 2, 3 or 4, best a constant.
uint listEntry(uint64_t_ConstPtr pool, uint place, uint per_word)
{
    if (per_word != 3u)
    {
        // By half words: shifts of 64 bits are dear.
        uint half_word = uint_ConstPtr(uint64_t(pool)).data[per_word == 4u ? place >> 1 : place];
        return per_word == 4u ? bitfieldExtract(half_word, int(16u * (place & 1u)), 16) : half_word;
    }
    uint bits = kListWordBits / per_word;
    return uint(pool.data[place / per_word] >> (bits * (place % per_word))) & ((1u << bits) - 1u);
}

#endif
