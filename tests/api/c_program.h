// SPDX-License-Identifier: MIT
// A host of zvo's in C, for a C++ program that has the device.
#pragma once

#include "zvo/zvo.h"

#ifdef __cplusplus
extern "C"
{
#endif

#define C_PROGRAM_PICTURES 6

    // What the program cannot do by zvo: all of it works on one image of width * height texels.
    typedef struct CHost
    {
        void* user;
        VkCommandBuffer (*begin)(void* user);
        void (*finish)(void* user, VkCommandBuffer commands); // submits and waits
        void (*beginCopies)(void* user, VkCommandBuffer commands);
        void (*endCopies)(void* user, VkCommandBuffer commands); // and reads the image
        void (*keep)(void* user);                                // what was read is the next picture
        ZvoContext* context;
        ZvoImageTarget image;
        uint32_t width;
        uint32_t height;
    } CHost;

    extern const float kCBoxCorners[24];
    extern const uint32_t kCBoxTriangles[36];

    // Shows an octree of a box, the same as a DAG, that with paths, a dynamic tree with a dynamic object, that after a
    // dab of a brush, and again with paths. Returns how many pictures it has kept.
    uint32_t runCProgram(const CHost* host);

#ifdef __cplusplus
}
#endif
