#version 460
// SPDX-License-Identifier: MIT
// Lists the components, in any order.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(LabelsParams, GPU_NO_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/dispatch.glsl"

void main()
{
    uint unit = threadIndex();
    bool is_root = false;
    if (unit != 0u && unit < params.unit_count) // unit 0 is what lies outside
        is_root = params.labels.data[unit] == unit;
    uint count = is_root ? 1u : 0u;
    uint total = subgroupAdd(count);
    uint place = subgroupExclusiveAdd(count);
    uint first = 0u;
    if (subgroupElect() && total != 0u)
        first = atomicAdd(params.counts.data[0].count, total);
    place += subgroupBroadcastFirst(first);
    if (!is_root)
        return;
    Component component = params.sizes.data[unit];
    component.root = unit;
    params.list.data[place] = component;
}
