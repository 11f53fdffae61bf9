// SPDX-License-Identifier: MIT
// What the kernels that pack attributes share with the host (docs/attributes.md).
#ifndef ZVO_SHADERS_ATTRIBUTES_ATTRIBUTES_H
#define ZVO_SHADERS_ATTRIBUTES_ATTRIBUTES_H

#include "shared/attribute_formats.h"

GPU_NAMESPACE_BEGIN

const uint kPackGroup = 64u; // threads of a workgroup, one an attribute or a block

struct PackWordsParams // push constants of attributes/pack4
{
    GPU_CONST_PTR(Attribute) attributes; // [count]
    GPU_PTR(uint) words;                 // [count]
    uint count;
};
GPU_KERNEL(attributes, pack4, Pack4, PackWordsParams, GPU_NO_CONSTANTS)

struct PackBlocksParams // push constants of attributes/block_colors and block_normals: one thread a block
{
    GPU_CONST_PTR(Attribute) attributes; // [count]
    GPU_PTR(uint) words;                 // [kBlockWords * ceil(count / kBlockVoxels)]
    uint count;
};
GPU_KERNEL(attributes, block_colors, BlockColors, PackBlocksParams, GPU_NO_CONSTANTS)
GPU_KERNEL(attributes, block_normals, BlockNormals, PackBlocksParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
