#version 460
// SPDX-License-Identifier: MIT
// Any tree, with levels of detail.
#extension GL_GOOGLE_include_directive : require
#define ZVO_DETAIL
#include "../picture.glsl"
