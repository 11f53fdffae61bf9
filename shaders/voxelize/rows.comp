#version 460
// SPDX-License-Identifier: MIT
// voxelize/rows.glsl, for every device.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/voxelize.h"

GPU_ENTRY(RasterParams, VOXELIZE_ROWS_CONSTANTS);

#include "lib/bound.glsl"
#include "voxelize/rows.glsl"
