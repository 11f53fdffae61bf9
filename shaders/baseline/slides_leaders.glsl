// SPDX-License-Identifier: MIT
// Compaction: the first of several neighbours that belong together is kept, at a place that the number of those before
// it tells. A workgroup counts those of its block; the counts of blocks are scanned, and a second pass finds the places.
#ifndef ZVO_SHADERS_BASELINE_SLIDES_LEADERS_GLSL
#define ZVO_SHADERS_BASELINE_SLIDES_LEADERS_GLSL

#define SCAN_GROUP kSlidesGroup
#include "baseline/slides.h"
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"

// Codes of a thread's consecutive elements, each with the one before.
struct SlidesCodes
{
    uint64_t before; // any other code than the first one's, for the first of all
    uint64_t codes[kSlidesItems];
};

SlidesCodes loadCodes(uint64_t_ConstPtr from, uint first, uint count)
{
    SlidesCodes result;
    [[unroll]] for (uint i = 0u; i < kSlidesItems; ++i)
        result.codes[i] = from.data[min(first + i, count - 1u)];
    result.before = first == 0u ? ~result.codes[0] : from.data[min(first, count) - 1u];
    return result;
}

// Bit i: element first + i exists, and its code above the lowest `shift` bits is not that of the element before.
uint leadersOf(SlidesCodes codes, uint first, uint count, uint shift)
{
    uint leaders = 0u;
    uint64_t before = codes.before;
    [[unroll]] for (uint i = 0u; i < kSlidesItems; ++i)
    {
        bool leads = first + i < count && ((codes.codes[i] ^ before) >> shift) != 0ul;
        leaders |= leads ? 1u << i : 0u;
        before = codes.codes[i];
    }
    return leaders;
}

// Writes how many elements the workgroup keeps. Call in uniform control flow.
void countKept(uint leaders, uint count, uint_Ptr partials)
{
    uint total;
    workgroupExclusiveAdd(uint(bitCount(leaders)), total);
    if (gl_LocalInvocationIndex == 0u && workgroupIndex() * kSlidesBlock < count)
        partials.data[workgroupIndex()] = total;
}

// The place of this thread's first kept element. Call in uniform control flow.
uint placeOfKept(uint leaders, uint count, uint_Ptr partials)
{
    uint total;
    uint place = workgroupExclusiveAdd(uint(bitCount(leaders)), total);
    return workgroupIndex() * kSlidesBlock < count ? place + partials.data[workgroupIndex()] : place;
}

#endif
