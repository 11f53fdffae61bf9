#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the changed leaves.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"
#include "lib/dispatch.glsl"

layout(constant_id = 0) const uint kLanes = 1u;

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    EditAverageParams params;
};

#define AVERAGE_CHILDREN Attribute_ConstPtr
#include "edit/average.glsl"

void main()
{
    uint number = threadIndex() / kLanes;
    averageCell(params.inner_count + number, number < params.cell_count - params.inner_count, params.voxels, 0u);
}
