#version 460
// SPDX-License-Identifier: MIT
// Trees that are known when the pipeline is made, with stacks in registers.
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 0) const uint kLevels = 1u;
layout(constant_id = 1) const uint kEntries = 0u;
#define ZVO_NODE_LEVELS kLevels
#define ZVO_ENTRIES_PER_WORD kEntries
#include "../picture.glsl"
