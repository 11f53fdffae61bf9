#version 460
// SPDX-License-Identifier: MIT
// Writes the root of the slot, and the children of changed cells: changed ones, and copies of the others. Clears the
// words of the emission table that the dab takes.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditNodesParams, EDIT_NODES_CONSTANTS);
layout(local_size_x = kEditGroup) in;

#include "edit/cells.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ranks.glsl"

const bool kRanks = kEntriesPerWord != 0u && kAttributes;

Node copyOf(EditCell cell)
{
    return Node(cell.mask_lo, cell.first, cell.mask_hi, cell.first + bitCount(cell.mask_lo));
}

// A child that the dab does not change; copies its attributes.
Node unchangedChild(EditCell parent, uint bit, bool is_leaf, uint index)
{
    RankSource source = RankSource(Node_ConstPtr(uint64_t(params.nodes)), params.before, params.voxels_before_leaf,
                                   params.first_short_entry);
    RankedNode at = RankedNode(parent.base, parent.voxels, parent.rank);
    descendBase(source, BeforeChild_ConstPtr(uint64_t(params.ranks)), bit, is_leaf, kRanks, at);
    uint64_t leaf_groups = kEntriesPerWord == 0u ? uint64_t(params.before) : 0ul;
    Node child = loadCopyOf(source.pool, uvec2_ConstPtr(leaf_groups), at.node);
    if (is_leaf)
    {
        child.base_lo += at.voxels;
        child.base_hi += at.voxels;
    }
    if (kRanks)
        params.ranks.data[index] = BeforeChild(is_leaf ? 0u : at.voxels, at.rank);
    if (kAttributes)
    {
        bool is_behind = isBehind(params.static_root, at.node);
        Attribute look = params.node_attributes.data[is_behind ? at.node + params.attribute_offset : at.rank];
        if (kEntriesPerWord == 0u && isFullNode(at.node))
            look = interiorLook(look);
        params.node_attributes.data[index + params.attribute_offset] = look;
    }
    return child;
}

void writeRoot(bool failed)
{
    uint index = params.slots.region_node + params.slots.to;
    uint from = params.slots.region_node + params.slots.from;
    EditCell cell = params.cells.data[0];
    bool changed = !failed && cell.changed != 0u;
    Node root = params.nodes.data[from];
    if (changed)
        root = copyOf(cell);
    params.nodes.data[index] = root;
    params.cells.data[0].node = index;
    if (kRanks)
        params.ranks.data[index] = BeforeChild(0u, 0u);
    if (kAttributes)
        params.node_attributes.data[index + params.attribute_offset] =
            params.node_attributes.data[from + params.attribute_offset];
}

// Every voxel has an index in its word, so that nothing needs to be counted.
void clearEmission()
{
    EditSlots slots = params.slots;
    uint begin = max(params.states.data[slots.from].voxel_top, params.states.data[params.kept].voxel_top);
    uint end = params.states.data[slots.to].voxel_top;
    uint thread_count = max(firstCell(params.box, params.box.level_count - 1u), 1u) * kEditGroup;
    for (uint word = ((begin + 31u) >> 5) + threadIndex(); 32u * word < end; word += thread_count)
        params.emission_words.data[word] = uvec2(0u, 32u * word + params.emission_offset);
}

void main()
{
    if (kEmits)
        clearEmission();
    bool failed = params.states.data[params.slots.to].failed != 0u;
    if (workgroupIndex() == 0u && gl_LocalInvocationIndex == 0u)
        writeRoot(failed);
    uint number = workgroupIndex();
    uint level = levelOf(params.box, number);
    if (failed || level + 1u >= params.box.level_count)
        return;
    EditCell cell = params.cells.data[workgroupIndex()];
    uint bit = gl_LocalInvocationIndex;
    Node copied = copyOf(cell);
    if (cell.changed == 0u || !hasChild(copied, bit))
        return;
    uint index = childIndex(copied, bit);
    bool is_leaf = level + 2u == params.box.level_count;
    uvec3 position = 4u * cellOf(params.box, level, number) + cellNumbered(bit);
    uint child_index = 0u;
    bool changed = false;
    if (isInBox(params.box, level + 1u, position))
    {
        child_index = firstCell(params.box, level + 1u) + cellNumber(params.box, level + 1u, position);
        changed = params.cells.data[child_index].changed != 0u;
    }
    if (changed)
    {
        EditCell child = params.cells.data[child_index];
        params.nodes.data[index] = copyOf(child);
        params.cells.data[child_index].node = index;
        if (kRanks)
            params.ranks.data[index] = BeforeChild(is_leaf ? 0u : child.voxels, child.rank);
    }
    else
    {
        params.nodes.data[index] = unchangedChild(cell, bit, is_leaf, index);
    }
}
