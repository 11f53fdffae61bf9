// SPDX-License-Identifier: MIT
// Parameters of the tests' kernels.
#ifndef ZVO_TESTS_KERNELS_TEST_PARAMS_H
#define ZVO_TESTS_KERNELS_TEST_PARAMS_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

struct FillParams // push constants
{
    GPU_PTR(uint) values; // [count]
    uint count;           // an odd number of words, so that the struct ends with padding
};
GPU_KERNEL(test, iota, Iota, FillParams, GPU_NO_CONSTANTS)
GPU_KERNEL(test, race, Race, FillParams, GPU_NO_CONSTANTS)
GPU_KERNEL(test, reversed, Reversed, FillParams, GPU_NO_CONSTANTS)
#define TEST_SPECIALIZED_CONSTANTS(CONSTANT)                                                                           \
    CONSTANT(0, uint, local_size_x, kLocalSizeX, 1u)                                                                   \
    CONSTANT(1, uint, value, kValue, 7u)                                                                               \
    CONSTANT(2, bool, flag, kFlag, false)
GPU_KERNEL(test, specialized, Specialized, FillParams, TEST_SPECIALIZED_CONSTANTS)

struct CopyParams // push constants
{
    GPU_CONST_PTR(uint) source; // [count]
    GPU_PTR(uint) destination;  // [count]
    uint count;
    uint factor;
};
GPU_KERNEL(test, bound, Bound, CopyParams, GPU_NO_CONSTANTS)
GPU_KERNEL(test, branch, Branch, CopyParams, GPU_NO_CONSTANTS)
GPU_KERNEL(test, scale, Scale, CopyParams, GPU_NO_CONSTANTS)

const uint kBoundMark = 1u << 30; // what the bound forms of test/bound and test/reached add

struct ReachedTable
{
    GPU_CONST_PTR(uvec3) triples; // [ReachedParams::count]
};
GPU_BUFFER(ReachedTable, 8);

struct ReachedParams // push constants
{
    GPU_CONST_PTR(ReachedTable) tables; // [1]
    GPU_PTR(uint) sums;                 // [count]
    uint count;
    uint padding;
};
GPU_KERNEL(test, reached, Reached, ReachedParams, GPU_NO_CONSTANTS)

struct WriteArgsParams // push constants
{
    GPU_PTR(DispatchArgs) args; // [1]
    uint groups;
};
GPU_KERNEL(test, write_args, WriteArgs, WriteArgsParams, GPU_NO_CONSTANTS)

struct Sample // every kind of member; no padding at its end, which GLSL would use for the next member
{
    vec3 position;
    uint id;
    uvec2 pair;
    mat4x3 transform;
    GPU_CONST_PTR(uvec4) address;
    uint list[4];
};

struct LayoutParams // push constants
{
    Sample a;
    float tail;
};
GPU_KERNEL(test, layout, Layout, LayoutParams, GPU_NO_CONSTANTS)

GPU_KERNEL(test, no_params, NoParams, void, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
