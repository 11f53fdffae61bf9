// SPDX-License-Identifier: MIT
// What the kernels of brush editing share with the host.
//
// A dab of a brush copies every path of a base tree that leads to a leaf which it changes, and changes the copy: the
// tree before it stays as it is, and older ones are shown again in constant time (persistent trees: J. Driscoll et al.,
// Making Data Structures Persistent, 1989; on voxel DAGs: V. Careil, M. Billeter, E. Eisemann, Interactively Modifying
// Compressed Sparse Voxel Representations, 2020). Copies stand in one region behind the static tree's nodes and
// attributes, and look like an overlay's nodes (update/update.h): children stand together, leaves have voxels' indices
// as bases, and above a DAG each has the rank of the static octree's node at its position; of leaves, only that of
// the node, as their bases are voxel numbers already.
//
//     nodes       | ... | roots, one a slot  | copies of dab 1 | dab 2 | ...                  room |
//     attributes  | ... | voxels of changed leaves: dab 1 | dab 2 | ...                       room |
//                                                             ▲ tops of the slot that is shown
//
// A *slot* has a root and an EditState, which says how far up the copies reach that it is made of. A dab begins at the
// state of the slot that it changes, and may overwrite whatever stands above that: undo shows an earlier slot, and a
// dab after it takes the room of the dabs that were undone. But a frame may be lost, whether or not the device has run
// it. So until the end of a frame, the room of the slot that was shown before it is not overwritten.
//
// The cells of a dab are the nodes, of all levels, that its box touches: the root first, each level x first. Their
// number depends on the brush alone, not on the tree.
#ifndef ZVO_SHADERS_EDIT_EDIT_H
#define ZVO_SHADERS_EDIT_EDIT_H

#include "octree/octree.h"
#include "shared/octree.h"
#include "shared/scene.h"
#include "shared/svdag.h"

GPU_NAMESPACE_BEGIN

const uint kEditGroup = 64u; // threads of most workgroups: for a node's children, or a leaf's voxels, one each

// The shape of a brush
const uint kBrushSphere = 0u; // voxels whose centres are less than half of the box's edge away from its middle
const uint kBrushBox = 1u;    // all voxels of the box

// Its action
const uint kBrushCarve = 0u; // takes voxels away
const uint kBrushFill = 1u;  // makes voxels where there are none; of a stamp, all voxels look like it then
const uint kBrushPaint = 2u; // gives voxels another colour and another emission, or none

const uint kBrushActionShift = 8u; // of the action in Brush::kind
const uint kBrushGrownShift = 16u; // of bits that say on which sides the dab's EditBox has been grown by one voxel: x,
                                   // y, z of its lower ones, then of its upper ones

const uint kBrushRadiusMax = 64u;                   // voxels
const uint kDabEdgeMax = 2u * kBrushRadiusMax + 1u; // of a dab's box

// A stamp has these words for each leaf that its box touches, in the order of cells: the mask of its voxels; then
// colour (with flags), normal and emission of each of the 64 cells.
const uint kStampMaskWords = 2u;
const uint kStampCellWords = 3u;
const uint kStampWords = kStampMaskWords + kStampCellWords * 64u;

// The word of a stamp with the bit of a leaf's cell. leaf: its number among the stamp's leaves.
GPU_FUNCTION uint stampMask(uint leaf, uint cell)
{
    return leaf * kStampWords + (cell >> 5u);
}

// The first word of what such a cell looks like.
GPU_FUNCTION uint stampCell(uint leaf, uint cell)
{
    return leaf * kStampWords + kStampMaskWords + kStampCellWords * cell;
}

const uint kFewLeaves = 64u; // cells: so many are averaged by the same workgroup as the few hundred at most above them

/// What a dab does, and where.
struct Brush
{
    ivec3 lo; // of the box that it fills; may lie outside of the grid, and of the dab's EditBox
    ivec3 hi;
    uint kind;     // shape | action << kBrushActionShift | sides << kBrushGrownShift
    uint color;    // of voxels that are made or painted: sRGB red | green << 8 | blue << 16 | flags of Attribute << 24
    uint emission; // of such voxels, with kAttributeEmissive: RGB9E5, as in the emission table
};

/// The voxels of the grid that a brush can reach, at least one, and the cells that they lie in. Where voxels are carved
/// from a filled tree, it is one voxel larger on all sides within the grid: what is laid bare gets attributes.
struct EditBox
{
    uvec3 lo;
    uvec3 hi; // the last one
    uint level_count;
};

/// A node of the base tree under the brush, or the empty place of a node that does not exist.
struct EditCell
{
    uint base;    // reference of the node of the base tree, or kNoEditNode
    uint voxels;  // rank of the static octree's node at the same position; of a leaf, the index of its first attribute
    uint rank;    // rank of that node among the nodes; of an octree, as of lib/ranks.glsl's descendBase()
    uint mask_lo; // after the dab
    uint mask_hi;
    uint before_lo; // before it; of leaves alone, as the next
    uint before_hi;
    uint surface_lo; // those of before that have attributes
    uint surface_hi;
    uint changed; // 0 or 1
    uint first; // of changed ones: the first child node, or the first voxel of a leaf; before edit/allocate: of leaves,
                // how many voxels the dab makes, modulo 2^32
    uint node;  // of changed ones: the copy
};
GPU_BUFFER(EditCell, 4);

const uint kNoEditNode = ~0u;

/// The ends of the nodes and voxels that a slot is made of.
struct EditState
{
    uint node_top;    // the first free node
    uint voxel_top;   // the first free voxel attribute
    uint voxel_count; // of the whole tree, modulo 2^32
    uint failed;      // 1: a dab had no room and was left out
};
GPU_BUFFER(EditState, 4);

/// The slots that a dab reads and writes.
struct EditSlots
{
    uint region_node; // the root of slot 0
    uint from;
    uint to;
};

struct EditBeginParams // push constants of edit/begin: makes slot 0 the static tree
{
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) node_attributes; // or null
    GPU_PTR(BeforeChild) ranks;         // by nodes of overlays; kRanks only
    GPU_PTR(EditState) states;
    uint static_root;
    uint region_node;
    uint attribute_offset;
    uint node_top;
    uint voxel_top;
    uint voxel_count;
};
#define EDIT_BEGIN_CONSTANTS(CONSTANT)                                                                                 \
    CONSTANT(0, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(1, bool, ranks, kRanks, false)
GPU_KERNEL(edit, begin, Begin, EditBeginParams, EDIT_BEGIN_CONSTANTS)

struct EditFindParams // push constants of edit/find: one thread a cell
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(BeforeChild) before; // this and the next as in RankSource
    GPU_CONST_PTR(uint) voxels_before_leaf;
    GPU_CONST_PTR(BeforeChild) ranks;
    GPU_PTR(EditCell) cells;
    GPU_CONST_PTR(uint) stamp; // [leaves * kStampWords] kStamp only
    uint root;                 // of the slot
    uint first_short_entry;
    Brush brush;
    EditBox box;
};
#define EDIT_FIND_CONSTANTS(CONSTANT)                                                                                  \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord,                                                               \
             0u) /* of the lists of a DAG; 0: the static tree is an octree */                                          \
    CONSTANT(1, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(2, bool, stamp, kStamp, false)     /* only voxels of a stamp */                                           \
    CONSTANT(3, bool, exposes, kExposes, false) /* what is laid bare changes as well: a filled tree is carved */
GPU_KERNEL(edit, find, Find, EditFindParams, EDIT_FIND_CONSTANTS)

struct EditAllocateParams // push constants of edit/allocate: one workgroup
{
    GPU_PTR(EditCell) cells;
    GPU_PTR(EditState) states;
    uint cell_count;
    uint inner_count; // cells that are no leaves
    uint from;
    uint to;
    uint kept;     // another slot whose room is not overwritten
    uint node_end; // of the region
    uint voxel_end;
    EditBox box;
};
#define EDIT_ALLOCATE_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, bool, attributes, kAttributes, false) /* voxels take room */                                           \
    CONSTANT(1, uint, local_size_x, kLocalSizeX, 1u)
GPU_KERNEL(edit, allocate, Allocate, EditAllocateParams, EDIT_ALLOCATE_CONSTANTS)

struct EditNodesParams // push constants of edit/nodes: a workgroup for each cell that is no leaf, one at least
{
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) node_attributes; // or null
    GPU_CONST_PTR(BeforeChild) before;  // this and the next as in RankSource
    GPU_CONST_PTR(uint) voxels_before_leaf;
    GPU_PTR(BeforeChild) ranks;
    GPU_PTR(EditCell) cells;
    GPU_CONST_PTR(EditState) states;
    GPU_PTR(uvec2) emission_words; // kEmits only
    EditSlots slots;
    uint kept; // as in EditAllocateParams
    uint first_short_entry;
    uint static_root;
    uint attribute_offset;
    uint emission_offset; // from a voxel to the index of its word's first value, modulo 2^32
    EditBox box;
};
#define EDIT_NODES_CONSTANTS(CONSTANT)                                                                                 \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord,                                                               \
             0u) /* of the lists of a DAG; 0: the static tree is an octree */                                          \
    CONSTANT(1, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(2, bool, emits, kEmits, false)
GPU_KERNEL(edit, nodes, Nodes, EditNodesParams, EDIT_NODES_CONSTANTS)

struct EditVoxelsParams // push constants of edit/voxels and edit/emission: a workgroup for each cell that is a leaf
{
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_CONST_PTR(EditCell) cells;
    GPU_CONST_PTR(EditState) states;
    GPU_PTR(Attribute) attributes;
    GPU_PTR(uvec2) emission_words; // or null
    GPU_PTR(uint) emission;        // or null
    GPU_CONST_PTR(uint) stamp;     // [leaves * kStampWords] kStamp only
    uint to;
    uint inner_count;
    Brush brush;
    EditBox box;
};
#define EDIT_EMISSION_CONSTANTS(CONSTANT) CONSTANT(0, bool, stamp, kStamp, false)
GPU_KERNEL(edit, emission, Emission, EditVoxelsParams, EDIT_EMISSION_CONSTANTS)
#define EDIT_VOXELS_CONSTANTS(CONSTANT)                                                                                \
    CONSTANT(0, bool, emits, kEmits, false)                                                                            \
    CONSTANT(1, bool, stamp, kStamp, false)     /* voxels look like those of a stamp */                                \
    CONSTANT(2, bool, exposes, kExposes, false) /* what is laid bare gets normals: a filled tree is carved */
GPU_KERNEL(edit, voxels, Voxels, EditVoxelsParams, EDIT_VOXELS_CONSTANTS)

struct EditCopyParams // push constants of edit/copy, behind edit/find: a workgroup for each cell that is a leaf
{
    GPU_CONST_PTR(Attribute) node_attributes; // kAttributes only, as the next
    GPU_CONST_PTR(EditCell) cells;
    GPU_CONST_PTR(Attribute) attributes;
    GPU_CONST_PTR(uvec2) emission_words; // kEmits only, as the next
    GPU_CONST_PTR(uint) emission;
    GPU_PTR(uint) stamp; // [leaves * kStampWords]
    uint inner_count;
    EditBox box;
};
#define EDIT_COPY_CONSTANTS(CONSTANT)                                                                                  \
    CONSTANT(0, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(1, bool, emits, kEmits, false)
GPU_KERNEL(edit, copy, Copy, EditCopyParams, EDIT_COPY_CONSTANTS)

struct EditStampParams // push constants of edit/stamp: a workgroup for each cell that is a leaf
{
    GPU_CONST_PTR(Node) nodes; // of the octree that becomes a stamp
    GPU_CONST_PTR(uvec2) leaf_groups;
    GPU_CONST_PTR(Attribute) node_attributes; // kAttributes only, as the next
    GPU_CONST_PTR(Attribute) attributes;
    GPU_CONST_PTR(uvec2) emission_words; // kEmits only, as the next
    GPU_CONST_PTR(uint) emission;
    GPU_PTR(uint) stamp; // [leaves * kStampWords] cleared
    ivec3 offset;        // of the octree's first voxel in the grid that is edited
    EditBox box;
};
#define EDIT_STAMP_CONSTANTS(CONSTANT)                                                                                 \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(2, bool, emits, kEmits, false)
GPU_KERNEL(edit, stamp, Stamp, EditStampParams, EDIT_STAMP_CONSTANTS)

struct EditAverageParams // push constants of edit/average: kLanes threads a cell that is a leaf
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(EditCell) cells;
    GPU_CONST_PTR(EditState) states;
    GPU_CONST_PTR(Attribute) voxels; // attributes
    GPU_PTR(Attribute) averages;     // of nodes
    uint inner_count;
    uint cell_count;
    uint to;
    uint attribute_offset; // from a node to averages
};
#define EDIT_AVERAGE_CONSTANTS(CONSTANT) CONSTANT(0, uint, lanes, kLanes, 1u)
GPU_KERNEL(edit, average, Average, EditAverageParams, EDIT_AVERAGE_CONSTANTS)

struct EditAverageTopParams // push constants of edit/average_top: one workgroup
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(EditCell) cells;
    GPU_CONST_PTR(EditState) states;
    GPU_CONST_PTR(Attribute) voxels; // attributes
    GPU_PTR(Attribute) averages;     // of nodes
    EditBox box;
    uint level_count; // the topmost ones are averaged
    uint to;
    uint attribute_offset; // from a node to averages
};
#define EDIT_AVERAGE_TOP_CONSTANTS(CONSTANT)                                                                           \
    CONSTANT(0, uint, lanes, kLanes, 1u)                                                                               \
    CONSTANT(1, uint, local_size_x, kLocalSizeX, 1u)
GPU_KERNEL(edit, average_top, AverageTop, EditAverageTopParams, EDIT_AVERAGE_TOP_CONSTANTS)

GPU_NAMESPACE_END

#endif
