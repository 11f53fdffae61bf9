#version 460
// SPDX-License-Identifier: MIT
// voxelize/rows.glsl, for every device.
#extension GL_GOOGLE_include_directive : require
#include "lib/bound.glsl"
#include "voxelize/rows.glsl"
