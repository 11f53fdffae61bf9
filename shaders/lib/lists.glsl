// SPDX-License-Identifier: MIT
// Lists of children in a pool (shared/svdag.h).
#ifndef ZVO_SHADERS_LIB_LISTS_GLSL
#define ZVO_SHADERS_LIB_LISTS_GLSL

#include "shared/svdag.h"

// The entry at a place. per_word: of all entries of the pool, 2, 3 or 4, best a constant.
uint listEntry(uint64_t_ConstPtr pool, uint place, uint per_word)
{
    uint bits = kListWordBits / per_word;
    uint64_t word = pool.data[place / per_word] >> (bits * (place % per_word));
    return bits == 32u ? uint(word) : uint(word) & ((1u << bits) - 1u);
}

#endif
