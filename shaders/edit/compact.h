// SPDX-License-Identifier: MIT
// What the kernels that compact edits (edit/edit.h) share with the host.
//
// The nodes and voxels of the slots that are kept move to another region; the rest is forgotten. Nodes and voxels keep
// their order, so that children stay together and the states of slots stay in the order of dabs.
#ifndef ZVO_SHADERS_EDIT_COMPACT_H
#define ZVO_SHADERS_EDIT_COMPACT_H

#include "edit/edit.h"

GPU_NAMESPACE_BEGIN

const uint kMarkSlot = ~0u; // root of a slot that is not used: stays where it is, whatever it holds

struct EditMarkParams // push constants of edit/mark: one thread a node of the region
{
    GPU_CONST_PTR(Node) nodes;
    GPU_PTR(uint) marks;      // [node_count] kept nodes of the region: 1 + the node's level, or kMarkSlot; 0: not kept
    GPU_PTR(uint) voxel_bits; // [ceil(voxel_count / 32)] bits of the region's voxels that are kept
    uint first_node;          // of the region
    uint node_count;
    uint first_voxel;
    uint voxel_count;
    uint level; // level of the nodes that mark their children, or voxels
};
#define EDIT_MARK_CONSTANTS(CONSTANT) CONSTANT(0, bool, leaves, kLeaves, false)
GPU_KERNEL(edit, mark, Mark, EditMarkParams, EDIT_MARK_CONSTANTS)

struct EditSumParams // push constants of edit/live_sums and edit/renumber: a workgroup for each kScanBlock elements
{
    GPU_CONST_PTR(uint) marks; // or words of voxel_bits: kVoxels
    GPU_PTR(uint) partials;    // of each workgroup; for edit/renumber, those before it
    GPU_PTR(uint) numbers;     // [element_count] what is kept before an element
    uint element_count;
};
#define EDIT_SUM_CONSTANTS(CONSTANT) CONSTANT(0, bool, voxels, kVoxels, false)
GPU_KERNEL(edit, live_sums, LiveSums, EditSumParams, EDIT_SUM_CONSTANTS)
GPU_KERNEL(edit, renumber, Renumber, EditSumParams, EDIT_SUM_CONSTANTS)

struct EditMoveParams // push constants of edit/move_nodes and edit/move_voxels: one thread a node, or voxel, of the
                      // region
{
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) node_attributes; // or null
    GPU_PTR(BeforeChild) ranks;         // kRanks only
    GPU_PTR(Attribute) attributes;      // or null
    GPU_PTR(uvec2) emission_words;      // of the new region cleared; or null
    GPU_CONST_PTR(uint) marks;
    GPU_CONST_PTR(uint) numbers; // of nodes
    GPU_CONST_PTR(uint) voxel_bits;
    GPU_CONST_PTR(uint) voxel_numbers; // of words of voxel_bits
    uint first_node;                   // of the old region
    uint node_count;
    uint first_voxel;
    uint voxel_count;
    uint new_first_node;
    uint new_first_voxel;
    uint level_count;
    uint attribute_offset;
};
#define EDIT_MOVE_NODES_CONSTANTS(CONSTANT)                                                                            \
    CONSTANT(0, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(1, bool, ranks, kRanks, false)
GPU_KERNEL(edit, move_nodes, MoveNodes, EditMoveParams, EDIT_MOVE_NODES_CONSTANTS)
#define EDIT_MOVE_VOXELS_CONSTANTS(CONSTANT) CONSTANT(0, bool, emits, kEmits, false)
GPU_KERNEL(edit, move_voxels, MoveVoxels, EditMoveParams, EDIT_MOVE_VOXELS_CONSTANTS)

struct EditMoveEmissionParams // push constants of edit/move_emission: one thread a voxel of the old region
{
    GPU_CONST_PTR(uint) voxel_bits;
    GPU_CONST_PTR(uint) voxel_numbers;
    GPU_CONST_PTR(uvec2) emission_words;
    GPU_PTR(uint) emission;
    uint first_voxel; // of the old region
    uint voxel_count;
    uint new_first_voxel;
};
GPU_KERNEL(edit, move_emission, MoveEmission, EditMoveEmissionParams, GPU_NO_CONSTANTS)

struct EditMoveStatesParams // push constants of edit/move_states: one thread a slot
{
    GPU_CONST_PTR(EditState) states;
    GPU_PTR(EditState) new_states;
    GPU_CONST_PTR(uint) marks;
    GPU_CONST_PTR(uint) numbers;
    GPU_CONST_PTR(uint) voxel_bits; // or null
    GPU_CONST_PTR(uint) voxel_numbers;
    uint slot_count;
    uint first_node; // of the old region
    uint node_count;
    uint first_voxel;
    uint voxel_count;
    uint new_first_node;
    uint new_first_voxel;
};
GPU_KERNEL(edit, move_states, MoveStates, EditMoveStatesParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
