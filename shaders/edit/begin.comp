#version 460
// SPDX-License-Identifier: MIT
// Makes slot 0 the unedited static tree.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditBeginParams, EDIT_BEGIN_CONSTANTS);
layout(local_size_x = kArgsGroup) in;

void main()
{
    if (gl_LocalInvocationIndex != 0u)
        return;
    params.nodes.data[params.region_node] = params.nodes.data[params.static_root];
    if (kAttributes)
        params.node_attributes.data[params.region_node + params.attribute_offset] =
            params.node_attributes.data[params.static_root + params.attribute_offset];
    if (kRanks)
        params.ranks.data[params.region_node] = BeforeChild(0u, 0u);
    params.states.data[0] = EditState(params.node_top, params.voxel_top, params.voxel_count, 0u);
}
