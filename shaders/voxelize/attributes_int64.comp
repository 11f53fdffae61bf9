#version 460
// SPDX-License-Identifier: MIT
// voxelize/attributes.glsl, for devices with 64-bit atomics. A module of its own, because others may not load it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_atomic_int64 : require
#define INT64_ATOMICS
#include "voxelize/bricks.h"

GPU_ENTRY(AttributesParams, VOXELIZE_ATTRIBUTES_CONSTANTS);

#include "lib/bound.glsl"
#include "voxelize/attributes.glsl"
