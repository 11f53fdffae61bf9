#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the changed leaves.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditAverageParams, EDIT_AVERAGE_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

#define AVERAGE_CHILDREN Attribute_ConstPtr
#include "edit/average.glsl"

void main()
{
    uint number = threadIndex() / kLanes;
    averageCell(params.inner_count + number, number < params.cell_count - params.inner_count, params.voxels, 0u);
}
