#version 460
// SPDX-License-Identifier: MIT
// Primary rays through a DAG whose attributes are wanted (trace/primary.glsl).
#extension GL_GOOGLE_include_directive : require
#define PRIMARY_RANKS
#include "trace/primary.glsl"
