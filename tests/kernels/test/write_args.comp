// SPDX-License-Identifier: MIT
// Writes the arguments of an indirect dispatch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "params.h"
#include "shared/gpu.h"

GPU_ENTRY(WriteArgsParams, GPU_NO_CONSTANTS);
layout(local_size_x = 1) in;

void main()
{
    params.args.data[0] = DispatchArgs(params.groups, 1, 1);
}
