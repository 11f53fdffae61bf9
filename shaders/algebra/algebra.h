// SPDX-License-Identifier: MIT
// Algebra of trees by the masks of their leaves: sets, dilation and erosion, connected components, enclosed space.
//
// An operation has octrees with leaf words as operands. It lists the bricks, blocks of 16^3 cells, in which its result
// may differ from empty or full, computes the masks of their leaves, and has an octree made of them, as voxelization
// does (octree/octree.h). Of a filled result, a node above bricks in which none is listed is full or empty as a whole.
//
// Components. The cells of a node, or of a leaf, that are matter fall apart into local components: *units*. Foreground
// is what is occupied: the voxels of leaves, and full nodes. Background is what is not: the cells of leaves, and the
// absent children of nodes. Units that touch across the sides of nodes are united, until each has the lowest number of
// its component as its label: locks and waiting are not needed (O. Komura, GPU-based cluster-labeling algorithm without
// the use of conventional iteration, 2015). Unit 0 is what lies outside of the grid.
#ifndef ZVO_SHADERS_ALGEBRA_ALGEBRA_H
#define ZVO_SHADERS_ALGEBRA_ALGEBRA_H

#include "octree/octree.h"
#include "voxelize/bricks.h"

GPU_ENUM(TreeOperation) // kUnite and so on
#define GPU_TYPE_TreeOperation uint

GPU_NAMESPACE_BEGIN

const uint kAlgebraGroup = 64u; // threads of a workgroup: leaves of a brick, or voxels of a leaf

const uint kUnite = 0u;     // a or b
const uint kIntersect = 1u; // a and b
const uint kSubtract = 2u;  // a, not b
const uint kKeep = 3u;      // what masks have of a
const uint kEnclose = 4u;   // a, and what masks have of the space around it
const uint kDilate = 5u;    // a, and all neighbours of its voxels
const uint kErode = 6u;     // voxels of a all of whose neighbours in the grid are in a

/// An octree with leaf words.
struct Operand
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) leaf_groups;
};

/// Attributes and emission of an octree's voxels.
struct Looks
{
    GPU_CONST_PTR(Attribute) voxels;
    GPU_CONST_PTR(uvec2) emission_words; // or null
    GPU_CONST_PTR(uint) emission;
};
GPU_BUFFER(Looks, 8);

struct PlacesParams // push constants of algebra/places: a thread a node of a level above leaves
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) leaf_groups; // or null: all nodes have plain numbers
    GPU_PTR(uvec2) places;            // [nodes of the octree] children get theirs (algebra/place.glsl)
    uint first_node;
    uint node_count;
};
GPU_KERNEL(algebra, places, Places, PlacesParams, GPU_NO_CONSTANTS)

struct ListAlgebraParams // push constants of algebra/bricks: a thread a brick of an operand
{
    Operand tree;
    Operand a;
    GPU_CONST_PTR(uvec2) places;
    GPU_PTR(BrickEntry) bricks;    // [brick_mask + 1]
    GPU_PTR(BinCounters) counters; // [1]
    uint brick_mask;
    uint brick_levels;
    uint first_node;
    uint node_count;
    uint brick_count; // bricks of the grid along each axis
};
#define ALGEBRA_BRICKS_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, grows, kGrows, false)     /* also bricks beside leaves */                                        \
    CONSTANT(2, bool, exposes, kExposes, false) /* also full bricks of a beside it */
GPU_KERNEL(algebra, bricks, ListAlgebra, ListAlgebraParams, ALGEBRA_BRICKS_CONSTANTS)

struct AlgebraParams // push constants of algebra/combine, algebra/spread, algebra/surface: a workgroup a listed brick
{
    Operand a;
    Operand b;                           // of operations with two
    GPU_CONST_PTR(uvec2) masks;          // [nodes of a] of kKeep and kEnclose: cells of nodes and leaves
    GPU_CONST_PTR(BrickEntry) bricks;    // [brick_mask + 1]
    GPU_CONST_PTR(BrickRange) ranges;    // [range_capacity]
    GPU_CONST_PTR(BinCounters) counters; // [1]
    GPU_PTR(uvec2) brick_masks;          // kBrickLeaves a brick: the result; of a filled one, voxels with attributes
    GPU_PTR(uvec2) inside; // of a filled result, 2 kBrickLeaves a brick, of which it takes the first kBrickLeaves
    GPU_PTR(uint) full;    // of a filled result, [ceil((brick_mask + 1) / 32)] bits of entries of full bricks
    uint brick_mask;
    uint brick_levels; // levels of nodes above that of bricks
    uint leaf_count;   // leaves of the grid along each axis
};
#define ALGEBRA_CONSTANTS(CONSTANT)                                                                                    \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, TreeOperation, operation, kOperation, kUnite)                                                          \
    CONSTANT(2, bool, corners, kCorners, false) /* all 26 neighbours; else the 6 across faces */                       \
    CONSTANT(3, bool, filled, kFilled, false)
GPU_KERNEL(algebra, combine, Combine, AlgebraParams, ALGEBRA_CONSTANTS)
GPU_KERNEL(algebra, spread, Spread, AlgebraParams, ALGEBRA_CONSTANTS)
GPU_KERNEL(algebra, surface, Surface, AlgebraParams, ALGEBRA_CONSTANTS)

struct AlgebraNodesParams // push constants of algebra/full_nodes: a thread a node above bricks, of a filled result
{
    Operand a;
    Operand b;
    GPU_CONST_PTR(uvec2) masks;       // as in AlgebraParams
    GPU_PTR(BrickEntry) bricks;       // [brick_mask + 1] masks get the children that are full
    GPU_CONST_PTR(uint) full;         // as in AlgebraParams
    GPU_CONST_PTR(WorkItem) items;    // [nodes]
    GPU_CONST_PTR(LevelRange) ranges; // [kNodeLevelsMax]
    GPU_PTR(BrickCounters) counters;  // [1]
    uint brick_mask;
    uint brick_levels;
    uint height; // of the nodes' level; of bricks: 0
};
GPU_KERNEL(algebra, full_nodes, FullNodes, AlgebraNodesParams, ALGEBRA_CONSTANTS)

struct LooksParams // push constants of algebra/looks: a workgroup a brick of the result
{
    GPU_CONST_PTR(SceneView) scene;
    Operand a;
    Operand b;
    GPU_CONST_PTR(Looks) looks;          // [2] of a and b
    GPU_CONST_PTR(Attribute) node_looks; // of the nodes of a
    GPU_CONST_PTR(Node) nodes;           // of the result: leaves are nodes, full nodes have empty masks
    GPU_CONST_PTR(uvec2) occupied;       // [leaves] of a filled result: surface and inside; or null
    GPU_CONST_PTR(uvec2) places;         // [nodes above leaves of the result]
    GPU_PTR(Attribute) attributes;       // [voxels]
    GPU_PTR(uvec2) emission_words;       // [ceil(voxels / 32)] get the bits of voxels that emit
    GPU_PTR(uint) emission;              // [emissive voxels] with kEmission
    uint first_leaf;
    uint first_brick;
    uint brick_count;
    uint leaf_edge; // leaves of the grid along each axis
};
#define ALGEBRA_LOOKS_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, TreeOperation, operation, kOperation, kUnite)                                                          \
    CONSTANT(1, bool, corners, kCorners, false)                                                                        \
    CONSTANT(2, bool, filled, kFilled, false)                                                                          \
    CONSTANT(3, bool, emits, kEmits, false)       /* voxels of an operand emit */                                      \
    CONSTANT(4, bool, emission, kEmission, false) /* copies emission; else attributes */
GPU_KERNEL(algebra, looks, FindLooks, LooksParams, ALGEBRA_LOOKS_CONSTANTS)

/// A connected component.
struct Component
{
    uint root;    // the lowest unit
    uint size_lo; // voxels
    uint size_hi;
    uvec3 voxel; // one of its voxels: the lowest corner of the root's first cell
};
GPU_BUFFER(Component, 4);

/// Counts of the passes of components.
struct ComponentCounts
{
    uint count;      // components
    uint unfinished; // unions or labels that took more steps than a thread has
};
GPU_BUFFER(ComponentCounts, 4);

/// What the kernels of components read and write.
struct UnitsParams // push constants of algebra/units, /unite, /sizes and /kept: a thread a node of the octree
{
    Operand tree;
    GPU_CONST_PTR(uvec2) places; // [nodes]
    GPU_PTR(uvec2) firsts;       // [nodes] the lowest cell of each of the node's units
    GPU_PTR(uvec2) ranks;        // [nodes] x: a bit for each unit; y: units before
    GPU_PTR(uint) labels;        // [units + 1]
    GPU_PTR(Component) sizes;    // [units + 1] of roots
    GPU_PTR(uvec2) kept;         // [nodes] of algebra/kept
    GPU_PTR(ComponentCounts) counts;
    uint node_count;
    uint inner_count;
    uint level_count;
    uint direction; // of algebra/unite: x | y << 2 | z << 4, each 0 to 2 for -1 to 1
    uint least_lo;  // of algebra/kept: components of more voxels are kept,
    uint least_hi;
    uint last_root; // and those of as many whose root is at most this
};
#define ALGEBRA_UNITS_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, bool, background, kBackground, false)                                                                  \
    CONSTANT(1, bool, corners, kCorners, false)
GPU_KERNEL(algebra, units, FindUnits, UnitsParams, ALGEBRA_UNITS_CONSTANTS)
GPU_KERNEL(algebra, unite, UniteUnits, UnitsParams, ALGEBRA_UNITS_CONSTANTS)
GPU_KERNEL(algebra, sizes, AddSizes, UnitsParams, ALGEBRA_UNITS_CONSTANTS)
GPU_KERNEL(algebra, kept, KeepUnits, UnitsParams, ALGEBRA_UNITS_CONSTANTS)

struct LabelsParams // push constants of algebra/labels and algebra/list: a thread a unit
{
    GPU_PTR(uint) labels;           // [unit_count]
    GPU_CONST_PTR(Component) sizes; // [unit_count] of algebra/list
    GPU_PTR(Component) list;        // [components]
    GPU_PTR(ComponentCounts) counts;
    uint unit_count;
};
#define ALGEBRA_LABELS_CONSTANTS(CONSTANT) CONSTANT(0, bool, clear, kClear, false) /* each unit is its own root */
GPU_KERNEL(algebra, labels, FlattenLabels, LabelsParams, ALGEBRA_LABELS_CONSTANTS)
GPU_KERNEL(algebra, list, ListComponents, LabelsParams, GPU_NO_CONSTANTS)

const uint kUnionSteps = 2048u; // of a thread, for all of its unions: what is left is taken up by the next pass

GPU_NAMESPACE_END

#endif
