// SPDX-License-Identifier: MIT
// What shaders need to know of a tree to trace rays through it and to read attributes of hits. The tree is an octree or
// a DAG, either with or without overlays. Shaders of hosts get the table by its address (host/trace.glsl).
#ifndef ZVO_SHADERS_SHARED_TREE_TABLE_H
#define ZVO_SHADERS_SHARED_TREE_TABLE_H

#include "shared/attribute_formats.h"
#include "shared/svdag.h"

GPU_NAMESPACE_BEGIN

/// Where a tree is in device memory, and its numbers. Addresses of what a tree lacks are 0.
struct TreeTable
{
    RankSource source;                        // pool: the nodes, of a DAG with its lists; the rest for ranks in a DAG
    GPU_CONST_PTR(BeforeChild) overlay_ranks; // by nodes of overlays above a DAG with ranks
    GPU_CONST_PTR(Attribute) attributes;      // of voxels, in the format of attribute_format
    GPU_CONST_PTR(Attribute) node_attributes; // of nodes, in that format; words of format 4 beside blocks
    GPU_CONST_PTR(uvec2) emission_words;      // of 32 voxels: bits of those that emit, index of the first one's value
    GPU_CONST_PTR(uint) emission;             // radiance / emission_scale as RGB9E5
    float emission_scale;
    uint attribute_format;    // kFormatNone to kFormatBlocks
    uint entries_per_word;    // of lists; 0: there are none
    uint attribute_offset;    // from an overlay's node above a DAG to the index of its attributes, modulo 2^32
    uint depth;               // 1 << depth voxels per edge of the grid
    uint node_levels;         // 4^node_levels voxels per edge of the root's cube
    uint first_dynamic_voxel; // index of attributes from which on they are those of overlays
    uint first_dynamic_node;
    vec3 origin;      // world position of the grid's minimum corner
    float voxel_size; // world units
};
GPU_BUFFER(TreeTable, 8);

GPU_NAMESPACE_END

#endif
