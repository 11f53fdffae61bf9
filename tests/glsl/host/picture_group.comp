#version 460
// SPDX-License-Identifier: MIT
// Any tree, with stacks in shared memory.
#extension GL_GOOGLE_include_directive : require
#define ZVO_GROUP 64
#include "../picture.glsl"
