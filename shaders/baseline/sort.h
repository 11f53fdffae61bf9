// SPDX-License-Identifier: MIT
// What the kernels that sort share with the host.
#ifndef ZVO_SHADERS_BASELINE_SORT_H
#define ZVO_SHADERS_BASELINE_SORT_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

const uint kSortGroup = 128u;     // threads of a workgroup; one counts two digits' keys of a subgroup in a word
const uint kSortItems = 16u;      // keys that a thread takes
const uint kSortBlock = 2048u;    // keys that a workgroup takes: kSortGroup * kSortItems
const uint kSortDigitBits = 8u;   // of a key, that a pass sorts by
const uint kSortDigits = 256u;    // 1 << kSortDigitBits
const uint kSortSubgroupMin = 4u; // threads of the smallest subgroup for which there is shared memory

struct SortCountParams // push constants of baseline/sort_count
{
    GPU_CONST_PTR(uint64_t) keys; // [key_count]
    GPU_PTR(uint) counts;         // [kSortDigits * block_count] keys with a digit in a block, by digits
    uint key_count;
    uint block_count; // ceil(key_count / kSortBlock)
    uint shift;       // of the digit in a key
};
GPU_KERNEL(baseline, sort_count, SortCount, SortCountParams, GPU_NO_CONSTANTS)

struct SortScatterParams // push constants of baseline/sort_scatter
{
    GPU_CONST_PTR(uint64_t) keys;     // [key_count]
    GPU_CONST_PTR(uint) indices;      // [key_count]; not with kFirst
    GPU_PTR(uint64_t) sorted_keys;    // [key_count]
    GPU_PTR(uint) sorted_indices;     // [key_count]
    GPU_CONST_PTR(uint) first_places; // [kSortDigits * block_count] the counts, scanned
    uint key_count;
    uint block_count;
    uint shift;
};
#define BASELINE_SORT_SCATTER_CONSTANTS(CONSTANT)                                                                      \
    CONSTANT(0, bool, first, kFirst, false) /* of all passes: keys have not been moved yet */
GPU_KERNEL(baseline, sort_scatter, SortScatter, SortScatterParams, BASELINE_SORT_SCATTER_CONSTANTS)

GPU_NAMESPACE_END

#endif
