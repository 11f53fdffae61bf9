// SPDX-License-Identifier: MIT
// The light tree: what light sampling needs to know of a tree's emissive voxels, and the kernels that make it.
//
// Its nodes are those nodes of the voxel tree that have emissive voxels below them, level by level, each level in
// Morton order, so the children of a node stand together. A node of the lowest level is a brick of 4x4x4 cells. A light
// is a face of an emissive voxel without an occupied voxel before it: an *exposed face*. Each node keeps a box around
// the emissive voxels below it, and how much light their exposed faces give in each of the six directions.
//
// A point with a surface normal chooses a light from the root down (A. Conty Estevez, C. Kulla, Importance Sampling of
// Many Lights with Adaptive Tree Splitting, 2018): a child with a probability in proportion to its importance
// (light/choose.glsl), in the brick one of six directions in the same way, and of its faces each alike.
#ifndef ZVO_SHADERS_LIGHT_LIGHT_TREE_H
#define ZVO_SHADERS_LIGHT_LIGHT_TREE_H

#include "shared/tree_table.h"

GPU_NAMESPACE_BEGIN

const uint kLightGroup = 64u; // threads of a workgroup that takes one node, each a cell or a child of it
const uint kLightFaces = 6u;  // directions of faces: +x, +y, +z, -x, -y, -z

const uint kLightNodeBytes = 40u;
const uint kLightPartBits = 5u; // of LightNode::parts

/// A node of the light tree: bounds and sums over the emissive voxels below it. What choosing a child loads of it are
/// the first three words of 64 bits.
struct LightNode
{
    uvec2 low;        // voxel with the lowest coordinates in the box: x 18 bits | y 18 | z 18
    uvec2 high;       // voxel with the highest ones
    float power;      // luminance of all exposed faces, summed
    uint parts;       // of the faces in each direction, in fractions of kLightPartBits bits, rounded up
    uint first_child; // its number among all nodes; of a brick, the brick's number
    uint mask_lo;     // cells of the node with emissive voxels below
    uint mask_hi;
    uint unused;
};
GPU_BUFFER(LightNode, 8);

/// The emissive voxels of a leaf.
struct LightBrick
{
    Node leaf;                  // bases: indices of the voxels' attributes
    uvec3 cell;                 // coordinates among the leaves
    uvec2 exposed[kLightFaces]; // a bit for each cell with an exposed face in that direction
};
GPU_BUFFER(LightBrick, 4);

/// A node of the light tree under construction: where the voxel tree has it.
struct LightItem
{
    uint node;   // of the voxel tree
    uint voxels; // in a DAG, the number of the voxels before it, which is added to the indices in its leaves
    uint rank;   // in a DAG, that of the octree's node, depth first
    uvec3 cell;  // coordinates at its level
    vec3 up;     // luminance of the exposed faces towards +x, +y and +z, summed
    vec3 down;   // towards -x, -y and -z
};
GPU_BUFFER(LightItem, 4);

/// The nodes of a level of the light tree.
struct LightLevel
{
    uint first;
    uint count;
};
GPU_BUFFER(LightLevel, 4);

struct LightExpandParams // push constants of light/expand: a workgroup for each node of a level above the leaves
{
    GPU_CONST_PTR(TreeTable) tree;
    GPU_CONST_PTR(LightItem) items;
    GPU_CONST_PTR(LightLevel) levels;
    GPU_PTR(LightNode) nodes;
    uint level;
};
#define LIGHT_EXPAND_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 0u) /* of the lists of a DAG; 0: the tree is an octree */     \
    CONSTANT(2, bool, flags, kFlags, true)                   /* nodes' attributes say whether a voxel below emits */
GPU_KERNEL(light, expand, Expand, LightExpandParams, LIGHT_EXPAND_CONSTANTS)

struct LightScanParams // push constants of light/scan: one workgroup
{
    GPU_PTR(LightNode) nodes;
    GPU_PTR(LightLevel) levels;
    GPU_PTR(DispatchArgs) args; // [levels] a workgroup for each node
    uint level;
    uint capacity; // of nodes
    uint max_groups_x;
};
GPU_KERNEL(light, scan, Scan, LightScanParams, GPU_NO_CONSTANTS)

struct LightChildrenParams // push constants of light/children: a workgroup for each node of a level above the leaves
{
    GPU_CONST_PTR(TreeTable) tree;
    GPU_PTR(LightItem) items;
    GPU_CONST_PTR(LightLevel) levels;
    GPU_CONST_PTR(LightNode) nodes;
    uint level;
};
#define LIGHT_CHILDREN_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 0u) /* of the lists of a DAG; 0: the tree is an octree */
GPU_KERNEL(light, children, Children, LightChildrenParams, LIGHT_CHILDREN_CONSTANTS)

struct LightBricksParams // push constants of light/bricks: a workgroup for each leaf
{
    GPU_CONST_PTR(TreeTable) tree;
    GPU_PTR(LightItem) items;
    GPU_CONST_PTR(LightLevel) levels;
    GPU_PTR(LightNode) nodes;
    GPU_PTR(LightBrick) bricks;
    uint level;
};
#define LIGHT_BRICKS_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 0u) /* of the lists of a DAG; 0: the tree is an octree */
GPU_KERNEL(light, bricks, Bricks, LightBricksParams, LIGHT_BRICKS_CONSTANTS)

struct LightReduceParams // push constants of light/reduce: a workgroup for each node of a level above the leaves
{
    GPU_PTR(LightItem) items;
    GPU_PTR(LightNode) nodes;
    GPU_CONST_PTR(LightLevel) levels;
    uint level;
};
GPU_KERNEL(light, reduce, Reduce, LightReduceParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
