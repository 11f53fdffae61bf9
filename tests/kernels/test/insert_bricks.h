// SPDX-License-Identifier: MIT
#ifndef ZVO_TESTS_KERNELS_TEST_INSERT_BRICKS_H
#define ZVO_TESTS_KERNELS_TEST_INSERT_BRICKS_H

#include "shared/bricks.h"

GPU_NAMESPACE_BEGIN

struct InsertBricksParams // push constants of test/insert_bricks
{
    GPU_PTR(BrickEntry) bricks; // [brick_mask + 1]
    GPU_CONST_PTR(uvec2) keys;  // [count]
    GPU_PTR(uvec2) results;     // [count] entry, 1 if this thread claimed it
    uint count;
    uint brick_mask;
};
GPU_KERNEL_BEGIN(test, insert_bricks, InsertBricks, InsertBricksParams)
    GPU_CONSTANT(bool, wide_keys, false)
    GPU_CONSTANT(bool, find, false)
GPU_KERNEL_END

GPU_NAMESPACE_END

#endif
