#version 460
// SPDX-License-Identifier: MIT
// Primary rays through a DAG whose attributes are wanted (trace/primary.glsl).
#extension GL_GOOGLE_include_directive : require
#define PRIMARY_RANKS
#include "trace/trace.h"

GPU_ENTRY(PrimaryRanksParams, TRACE_PRIMARY_RANKS_CONSTANTS);

#include "lib/bound.glsl"
#include "trace/primary.glsl"
