#version 460
// SPDX-License-Identifier: MIT
// voxelize/attributes.glsl, for every device.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(AttributesParams, VOXELIZE_ATTRIBUTES_CONSTANTS);

#include "lib/bound.glsl"
#include "voxelize/attributes.glsl"
