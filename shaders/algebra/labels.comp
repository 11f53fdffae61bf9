#version 460
// SPDX-License-Identifier: MIT
// Gives each unit its root as its label; or, to begin with, itself.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(LabelsParams, ALGEBRA_LABELS_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "lib/dispatch.glsl"

void main()
{
    uint unit = threadIndex();
    if (unit >= params.unit_count)
        return;
    if (kClear)
    {
        params.labels.data[unit] = unit;
        return;
    }
    uint label = unit;
    uint next = params.labels.data[unit];
    for (uint step = 0u; next != label && step < kUnionSteps; ++step)
    {
        label = next;
        next = params.labels.data[label];
    }
    params.labels.data[unit] = label;
    if (next != label)
        atomicAdd(params.counts.data[0].unfinished, 1u);
}
