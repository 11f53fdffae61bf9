#version 460
// SPDX-License-Identifier: MIT
// Computes the attributes of the changed nodes of a level.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"
#include "lib/average.glsl"
#include "lib/dispatch.glsl"

layout(local_size_x = kNodesGroup) in;
layout(push_constant, scalar) uniform Push
{
    EditAverageParams params;
};

void main()
{
    uint number = threadIndex();
    if (number >= params.cell_count || params.states.data[params.to].failed != 0u)
        return;
    EditCell cell = params.cells.data[params.first_cell + number];
    bool is_there = (cell.mask_lo | cell.mask_hi) != 0u;
    bool is_root = params.first_cell + number == 0u;
    if (cell.changed == 0u || !(is_there || is_root))
        return;
    Node node = Node(cell.mask_lo, cell.first + params.children_offset, cell.mask_hi, 0u);
    Attribute look = Attribute(0u, 0u);
    if (is_there)
        look = averageChildren(params.scene, node, params.children);
    params.averages.data[cell.node + params.attribute_offset] = look;
}
