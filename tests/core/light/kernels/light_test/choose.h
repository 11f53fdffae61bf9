// SPDX-License-Identifier: MIT
#ifndef ZVO_TESTS_LIGHT_TEST_CHOOSE_H
#define ZVO_TESTS_LIGHT_TEST_CHOOSE_H

#include "light/light_tree.h"

GPU_NAMESPACE_BEGIN

struct TestPlace
{
    vec3 position; // unit space
    uint normal;   // as in LightBrick::exposed
};
GPU_BUFFER(TestPlace, 4);

struct TestFace
{
    uvec3 cell;
    uint face;
    float probability; // of being chosen
};
GPU_BUFFER(TestFace, 4);

struct ChooseParams // push constants of light_test/choose: a thread a face of each place
{
    GPU_CONST_PTR(LightNode) nodes;
    GPU_CONST_PTR(LightBrick) bricks;
    GPU_CONST_PTR(TestPlace) places;
    GPU_PTR(TestFace) faces; // [places][face_count] with kChoose written, otherwise their probabilities
    uint place_count;
    uint face_count;
};
#define LIGHT_TEST_CHOOSE_CONSTANTS(CONSTANT)                                                                          \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, bool, choose, kChoose, false)
GPU_KERNEL(light_test, choose, Choose, ChooseParams, LIGHT_TEST_CHOOSE_CONSTANTS)

struct SamplesParams // push constants of light_test/samples: a thread a sample
{
    GPU_PTR(uvec2) samples; // [count]
    uint count;
    uint seed;
    uint pair;
};
GPU_KERNEL(light_test, samples, Samples, SamplesParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
