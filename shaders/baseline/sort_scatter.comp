#version 460
// SPDX-License-Identifier: MIT
// Moves the keys of a block to their places. A key's place is the first one of its digit in the block, plus the keys of
// that digit before it: in earlier subgroups, in earlier items of its own, and in the item itself. Subgroups take their
// keys one after the other, so keys of a digit keep their order. Within an item, keys find those of their digit by
// ballots, a bit at a time (S. Ashkiani, A. Davidson, U. Meyer, J. Owens, GPU Multisplit, 2016).
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "baseline/sort.h"

GPU_ENTRY(SortScatterParams, BASELINE_SORT_SCATTER_CONSTANTS);
layout(local_size_x = kSortGroup) in;

#include "lib/dispatch.glsl"

// Two digits a word, as a block has fewer keys than 16 bits count.
const uint kWords = kSortDigits / 2u;
shared uint s_counts[kSortGroup / kSortSubgroupMin * kWords]; // by subgroups: keys of each digit
shared uint s_places[kSortDigits];

uint digitOf(uint64_t key)
{
    return uint(key >> params.shift) & (kSortDigits - 1u);
}

uint halfOf(uint word, uint digit)
{
    return (word >> (16u * (digit & 1u))) & ((1u << 16) - 1u);
}

uint countsWord(uint digit)
{
    return gl_SubgroupID * kWords + (digit >> 1);
}

// The threads of this subgroup that have the same digit, of those for which exists.
uvec4 threadsWithDigit(uint digit, bool exists)
{
    uvec4 same = subgroupBallot(exists);
    [[unroll]] for (uint bit = 0u; bit < kSortDigitBits; ++bit)
    {
        bool is_set = ((digit >> bit) & 1u) != 0u;
        uvec4 set = subgroupBallot(is_set);
        same &= is_set ? set : ~set;
    }
    return same;
}

// Counts a key, and returns how many of its digit this subgroup has counted before. Call in uniform control flow.
uint rankKey(uint digit, bool exists)
{
    uvec4 same = threadsWithDigit(digit, exists);
    uint before_in_item = subgroupBallotExclusiveBitCount(same);
    uint before = 0u;
    if (exists && before_in_item == 0u)
        before = halfOf(atomicAdd(s_counts[countsWord(digit)], subgroupBallotBitCount(same) << (16u * (digit & 1u))),
                        digit);
    subgroupMemoryBarrierShared();
    uint leader = exists ? subgroupBallotFindLSB(same) : gl_SubgroupInvocationID;
    return subgroupShuffle(before, leader) + before_in_item;
}

// Replaces the counts of each subgroup by those of all subgroups before it.
void scanSubgroups()
{
    uint before = 0u;
    for (uint i = 0u; i < gl_NumSubgroups; ++i)
    {
        uint counts = s_counts[i * kWords + gl_LocalInvocationIndex];
        s_counts[i * kWords + gl_LocalInvocationIndex] = before;
        before += counts;
    }
}

void main()
{
    uint block = workgroupIndex();
    if (block >= params.block_count)
        return;
    for (uint i = 0u; i < gl_NumSubgroups; ++i)
        s_counts[i * kWords + gl_LocalInvocationIndex] = 0u;
    for (uint digit = gl_LocalInvocationIndex; digit < kSortDigits; digit += kSortGroup)
        s_places[digit] = params.first_places.data[digit * params.block_count + block];
    barrier();

    uint first = block * kSortBlock + gl_SubgroupID * gl_SubgroupSize * kSortItems + gl_SubgroupInvocationID;
    uint64_t keys[kSortItems];
    uint ranks[kSortItems];
    [[unroll]] for (uint i = 0u; i < kSortItems; ++i)
    {
        uint at = first + i * gl_SubgroupSize;
        bool exists = at < params.key_count;
        keys[i] = exists ? params.keys.data[at] : 0ul;
        ranks[i] = rankKey(digitOf(keys[i]), exists);
    }
    barrier();
    scanSubgroups();
    barrier();
    [[unroll]] for (uint i = 0u; i < kSortItems; ++i)
    {
        uint at = first + i * gl_SubgroupSize;
        uint digit = digitOf(keys[i]);
        uint place = s_places[digit] + halfOf(s_counts[countsWord(digit)], digit) + ranks[i];
        if (at < params.key_count)
        {
            params.sorted_keys.data[place] = keys[i];
            params.sorted_indices.data[place] = kFirst ? at : params.indices.data[at];
        }
    }
}
