#version 460
// SPDX-License-Identifier: MIT
// Primary rays (trace/primary.glsl).
#extension GL_GOOGLE_include_directive : require
#include "lib/bound.glsl"
#include "trace/primary.glsl"
