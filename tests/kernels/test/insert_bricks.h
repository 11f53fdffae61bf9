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
#define TEST_INSERT_BRICKS_CONSTANTS(CONSTANT)                                                                         \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(1, bool, find, kFind, false)          /* look for keys of an earlier dispatch instead */
GPU_KERNEL(test, insert_bricks, InsertBricks, InsertBricksParams, TEST_INSERT_BRICKS_CONSTANTS)

GPU_NAMESPACE_END

#endif
