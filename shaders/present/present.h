// SPDX-License-Identifier: MIT
// What the kernels that bring pictures to a window share with the host.
#ifndef ZVO_SHADERS_PRESENT_PRESENT_H
#define ZVO_SHADERS_PRESENT_PRESENT_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

const uint kScaleRows = 8u;   // pixels that a thread of present/scale takes: one division finds their column
const uint kScaleGroup = 64u; // threads of a workgroup of present/scale

/// Both pictures are rows of pixels from the top left, each red | green << 8 | blue << 16 | alpha << 24.
struct ScaleParams // push constants of present/scale: one thread kScaleRows pixels of a column
{
    GPU_CONST_PTR(uint) from; // [from_size.x * from_size.y]
    GPU_PTR(uint) to;         // [to_size.x * to_size.y]
    uvec2 from_size;          // at most 16384 along each edge, both
    uvec2 to_size;
};
GPU_KERNEL(present, scale, Scale, ScaleParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
