// SPDX-License-Identifier: MIT
// What the kernels of the slides' algorithms share with the host.
#ifndef ZVO_SHADERS_BASELINE_SLIDES_H
#define ZVO_SHADERS_BASELINE_SLIDES_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

const uint kSlidesGroup = 64u;  // threads of a workgroup
const uint kSlidesItems = 8u;   // consecutive elements that a thread takes where their sums are scanned
const uint kSlidesBlock = 512u; // elements that a workgroup takes there: kSlidesGroup * kSlidesItems

const uint kSlidesTooMany = ~0u; // a total that does not fit 32 bits

struct SlidesScanParams // push constants of baseline/slides_scan_sums and baseline/slides_scan_apply
{
    GPU_PTR(uint) values;   // [count]
    GPU_PTR(uint) partials; // [ceil(count / kSlidesBlock)] sums of blocks; to be scanned in between
    uint count;
};
GPU_KERNEL(baseline, slides_scan_sums, SlidesScanSums, SlidesScanParams)
GPU_KERNEL(baseline, slides_scan_apply, SlidesScanApply, SlidesScanParams)

struct SlidesScanTopParams // push constants of baseline/slides_scan_top: one workgroup
{
    GPU_PTR(uint) values; // [count]
    GPU_PTR(uint) total;  // [1] gets the sum of all values, or kSlidesTooMany
    uint count;
};
GPU_KERNEL(baseline, slides_scan_top, SlidesScanTop, SlidesScanTopParams)

GPU_NAMESPACE_END

#endif
