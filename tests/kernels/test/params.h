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

struct CopyParams // push constants
{
    GPU_CONST_PTR(uint) source; // [count]
    GPU_PTR(uint) destination;  // [count]
    uint count;
    uint factor;
};

struct WriteArgsParams // push constants
{
    GPU_PTR(DispatchArgs) args; // [1]
    uint groups;
};

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

GPU_NAMESPACE_END

#endif
