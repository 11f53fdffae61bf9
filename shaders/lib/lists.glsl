// SPDX-License-Identifier: MIT
// Lists of children in a pool (shared/svdag.h).
#ifndef ZVO_SHADERS_LIB_LISTS_GLSL
#define ZVO_SHADERS_LIB_LISTS_GLSL

#include "shared/svdag.h"

// The entry with an index. per_word: of all entries of the pool, 2, 3 or 4, best a constant.
uint listEntry(uint64_t_ConstPtr pool, uint index, uint per_word)
{
    if (per_word != 3u)
    {
        // Reads half words, because shifts of 64 bits are slow.
        uint half_word = uint_ConstPtr(uint64_t(pool)).data[per_word == 4u ? index >> 1 : index];
        return per_word == 4u ? bitfieldExtract(half_word, int(16u * (index & 1u)), 16) : half_word;
    }
    uint bits = kListWordBits / per_word;
    return uint(pool.data[index / per_word] >> (bits * (index % per_word))) & ((1u << bits) - 1u);
}

// Four entries, whose words are loaded together.
uvec4 listEntries(uint64_t_ConstPtr pool, uvec4 indices, uint per_word)
{
    return uvec4(listEntry(pool, indices.x, per_word), listEntry(pool, indices.y, per_word),
                 listEntry(pool, indices.z, per_word), listEntry(pool, indices.w, per_word));
}

#endif
