#version 460
// SPDX-License-Identifier: MIT
// Primary rays (trace/primary.glsl).
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"

GPU_ENTRY(PrimaryParams, TRACE_PRIMARY_CONSTANTS);

#include "lib/bound.glsl"
#include "trace/primary.glsl"
