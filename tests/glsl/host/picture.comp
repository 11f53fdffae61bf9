#version 460
// SPDX-License-Identifier: MIT
// Any tree.
#extension GL_GOOGLE_include_directive : require
#include "../picture.glsl"
