// SPDX-License-Identifier: MIT
// The attributes of the nodes that a dab changes.
// Needs AVERAGE_CHILDREN and kLanes as lib/average.glsl does, params.cells, params.states, params.to, params.scene,
// params.averages and params.attribute_offset.
#ifndef ZVO_SHADERS_EDIT_AVERAGE_GLSL
#define ZVO_SHADERS_EDIT_AVERAGE_GLSL

#include "edit/cells.glsl"
#include "edit/edit.h"
#include "lib/average.glsl"

// Averages the node of a cell that has changed. children_offset: from a cell's first child to children. Call in uniform
// control flow.
void averageCell(uint index, bool exists, AVERAGE_CHILDREN children, uint children_offset)
{
    EditCell cell = unchangedCell(0u, 0u, 0u, uvec2(0u));
    if (exists && params.states.data[params.to].failed == 0u)
        cell = params.cells.data[index];
    bool has_children = (cell.mask_lo | cell.mask_hi) != 0u;
    bool is_written = cell.changed != 0u && (has_children || index == 0u); // of an empty tree, the root is left
    Node node = Node(0u, 0u, 0u, 0u);
    if (is_written)
        node = Node(cell.mask_lo, cell.first + children_offset, cell.mask_hi, 0u);
    Attribute mean = averageChildren(params.scene, node, children);
    if (is_written && laneOfNode() == 0u)
        params.averages.data[cell.node + params.attribute_offset] = has_children ? mean : Attribute(0u, 0u);
}

#endif
