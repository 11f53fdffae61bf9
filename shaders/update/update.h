// SPDX-License-Identifier: MIT
// What the kernels of dynamic update share with the host.
//
// A layer is what voxelization makes of one moving mesh: its bricks, their leaves, and sums over the fragments of each
// of its voxels. An overlay is a copy of every path of a base tree that leads to a leaf which some layer has,
// merged with the layers. It stands behind the base tree's nodes and attributes, in the same buffers:
//
//   - nodes[0] is the root that is traced: a copy of the root chosen last. Nobody else reads or writes it.
//   - The overlay's root is the first node of its region; then come its levels, breadth first in Morton order.
//   - The children of an overlay's node stand together, as in an octree: those that no layer touches are copies of the
//     base tree's nodes, whose own children stay where they are.
//   - A touched leaf of an overlay has attributes of its own for all of its voxels, in the order of the leaves.
//
// The base tree is an octree or a DAG (shared/svdag.h). A DAG's nodes stand at many positions, and so do not tell
// which attributes are theirs: with attributes, every node of an overlay has, in an array beside it, the rank of the
// base octree's node at its position. A copy of a leaf has the index of its first voxel's attribute, as an octree's
// leaf. Attributes of a DAG's nodes stand depth first, as many as the octree had; those of overlays' nodes stand behind
// them, attribute_offset from the nodes' numbers.
//
// A node of the overlay that stands above a leaf of a layer is touched. Touched nodes have entries in a brick table, as
// nodes under construction do (shared/bricks.h).
//
// A layer may *carve*: it takes its voxels, and those that are inside of its mesh, from the base tree. Its records are
// masks of nodes of any level, leaves' voxels or inner nodes' children, which are cut as a whole. Then touched nodes
// have elements of another array, CarvedNode: nodes that lose all their children are not in the overlay.
#ifndef ZVO_SHADERS_UPDATE_UPDATE_H
#define ZVO_SHADERS_UPDATE_UPDATE_H

#include "octree/octree.h"
#include "shared/bricks.h"
#include "shared/octree.h"
#include "shared/scene.h"
#include "shared/svdag.h"
#include "voxelize/bricks.h"
#include "voxelize/voxelize.h"

GPU_ENUM(MergeRule) // kMergeAverage and so on
#define GPU_TYPE_MergeRule uint

GPU_NAMESPACE_BEGIN

const uint kLayersMax = 1024u;  // in one overlay
const uint kNoNode = ~0u;       // in a base tree
const uint kUpdateGroup = 64u;  // threads of most workgroups: for a node's children, one each
const uint kMergeThreads = 16u; // of a workgroup that take one leaf: mostly one for each of its voxels

// Specialization constant of update/merge: the attributes of a voxel that both the base tree and layers have.
const uint kMergeAverage = 0u; // the mean over the fragments of both
const uint kMergeDynamic = 1u; // the layers
const uint kMergeStatic = 2u;  // the base tree

// Why an update has failed: bits of UpdateStatus::failed.
const uint kFailedLayer = 1u;      // a layer had not enough room: LayerCounters tell which
const uint kFailedTable = 2u;      // the table of touched nodes
const uint kFailedNodes = 4u;      // the overlay's region
const uint kFailedVoxels = 8u;     // the region of the overlay's voxels
const uint kFailedFragments = 16u; // more fragments in a voxel than sums hold

/// The counts of a layer. Counting continues past the capacities.
struct LayerCounters
{
    uint leaf_count;
    uint voxel_count;
    uint failed;      // 1: something had no room, the layer is of no use
    uint arrived;     // threads that have listed leaves (lib/arrivals.glsl)
    BinCounters bins; // of its voxelization
};
GPU_BUFFER(LayerCounters, 4);

/// The buffers of a layer.
struct Layer
{
    GPU_CONST_PTR(LayerCounters) counters; // [1]
    GPU_CONST_PTR(uvec2) keys;             // [leaf_capacity] of the leaves, in any order (shared/bricks.h)
    GPU_CONST_PTR(Node) leaves;            // [leaf_capacity] masks, and bases in sums; where it carves, of any nodes
    GPU_CONST_PTR(VoxelSums) sums;         // [voxel_capacity]
    GPU_CONST_PTR(uvec2)
    emission_words;                            // [ceil(voxel_capacity / 32)] bits of voxels that emit, index in
                                               // emission_sums of the word's first; null if nothing does
    GPU_CONST_PTR(EmissionSums) emission_sums; // [voxel_capacity], by the indices of emission_words
    uint first_record;                         // the records before it: the leaf capacities of the layers before
    uint leaf_capacity;
    uint kind; // bits kLayer*
    uint unused;
};
GPU_BUFFER(Layer, 8);

// Of a layer that carves, bits of Layer::kind. Its keys are those of a grid of twice as many voxels an edge; at depth 1
// of four times as many, at depth 17 of the same.
const uint kLayerCarves = 1u;
const uint kLayerDeeper = 2u;   // that grid has a level of nodes more
const uint kLayerWideKeys = 4u; // and wide keys

/// What carving makes of a touched node: masks of its children or, of a leaf, of its voxels.
struct CarvedNode
{
    uint cut_lo; // those that are cut as a whole
    uint cut_hi;
    uint left_lo; // those that the overlay has
    uint left_hi;
    uint listed; // 1: the node is in the overlay
};
GPU_BUFFER(CarvedNode, 4);

/// A leaf of a layer in the chain of those with the same key.
struct LayerLink
{
    uint next;  // record + 1 of the next one, 0 at the end
    uint layer; // that the record belongs to
};
GPU_BUFFER(LayerLink, 4);

/// The nodes that belong to an entry of the table of touched nodes.
struct TouchedNode
{
    uint node; // its index
    uint base; // reference of the node of the base tree at the same position, or kNoNode
};
GPU_BUFFER(TouchedNode, 4);

/// The nodes of one level of the overlay.
struct OverlayLevel
{
    uint first_node;
    uint node_count;
};
GPU_BUFFER(OverlayLevel, 4);

/// The result of an update, which the host reads. Counting continues past the capacities.
struct UpdateStatus
{
    uint failed;        // bits kFailed*; not 0: the root is the one that was shown before
    uint node_count;    // of the overlay, its root included
    uint voxel_count;   // attributes of the overlay
    uint touched_count; // nodes in the table
    uint dynamic_count; // voxels of the layers' union
    uint max_fragments; // the most fragments of a merged voxel, if they are more than kFragmentsMax, else 0
};
GPU_BUFFER(UpdateStatus, 4);

// Elements of the indirect arguments of an update.
const uint kArgsExpand = 0u; // a workgroup for each touched node of the level above
const uint kArgsAssign = 1u; // for each kScanBlock nodes of the level
const uint kArgsMerge = 2u;  // kMergeThreads for each touched leaf
const uint kArgsCount = 3u;

/// What an update knows of itself on the device.
struct OverlayState
{
    UpdateStatus status;
    GPU_PTR(DispatchArgs) args;          // [kArgsCount]
    GPU_PTR(CarvedNode) carved;          // [brick_capacity] cleared; kCarves only
    OverlayLevel levels[kNodeLevelsMax]; // from the root's on, as far as they have been sized
    uint arrived[kNodeLevelsMax];        // threads that have expanded a level (lib/arrivals.glsl)
    uint level_count;
    uint node_capacity; // of the overlay's region
    uint voxel_capacity;
    uint max_groups_x;
};
GPU_BUFFER(OverlayState, 8);

struct LayerLeavesParams // push constants of update/layer_leaves: kBrickLanes threads a brick
{
    GPU_PTR(BrickEntry) bricks;       // get the numbers of the bricks' nodes
    GPU_CONST_PTR(BrickRange) ranges; // [brick_capacity]
    GPU_CONST_PTR(uint) masks;
    GPU_CONST_PTR(uint) crossings; // as voxelize/fill leaves them
    GPU_PTR(BinCounters) bins;
    GPU_PTR(uvec2) keys;             // [leaf_capacity]
    GPU_PTR(Node) nodes;             // [brick_capacity] of bricks, then [leaf_capacity] of leaves
    GPU_PTR(LayerCounters) counters; // [1] cleared
    GPU_PTR(LayerCounters) reports;  // copies that the host can read
    uint window;
    uint brick_capacity;
    uint leaf_capacity;
    uint voxel_capacity;
    uint report; // element of reports
};
#define UPDATE_LAYER_LEAVES_CONSTANTS(CONSTANT)                                                                        \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(1, uint, brick_lanes, kBrickLanes, 2u)                                                                    \
    CONSTANT(2, bool, carves, kCarves, false)                                                                          \
    CONSTANT(3, uint, fill_words, kFillWords, 0u) /* of a range's crossings; 0: nothing is filled */
GPU_KERNEL(update, layer_leaves, LayerLeaves, LayerLeavesParams, UPDATE_LAYER_LEAVES_CONSTANTS)

struct LayerParentsParams // push constants of update/layer_parents: a thread a brick
{
    GPU_PTR(BrickEntry) bricks; // [brick_mask + 1] get the nodes above bricks, with the masks of their children
    GPU_CONST_PTR(BrickRange) ranges;
    GPU_PTR(BinCounters) bins;
    uint window;
    uint brick_mask;
};
#define UPDATE_LAYER_PARENTS_CONSTANTS(CONSTANT) CONSTANT(0, bool, wide_keys, kWideKeys, false)
GPU_KERNEL(update, layer_parents, LayerParents, LayerParentsParams, UPDATE_LAYER_PARENTS_CONSTANTS)

struct LayerNodesParams // push constants of update/layer_nodes: a thread an entry of the table
{
    GPU_PTR(BrickEntry) bricks; // [brick_mask + 1]
    GPU_CONST_PTR(BinCounters) bins;
    GPU_PTR(uvec2) keys;             // [leaf_capacity]
    GPU_PTR(Node) nodes;             // [brick_capacity] of bricks, then [leaf_capacity]
    GPU_PTR(LayerCounters) counters; // [1] cleared
    uint window;
    uint brick_mask;
    uint brick_capacity;
    uint leaf_capacity;
};
#define UPDATE_LAYER_NODES_CONSTANTS(CONSTANT) CONSTANT(0, bool, wide_keys, kWideKeys, false)
GPU_KERNEL(update, layer_nodes, LayerNodes, LayerNodesParams, UPDATE_LAYER_NODES_CONSTANTS)

struct EmissionPlacesParams // push constants of update/emission_places
{
    GPU_PTR(uvec2) words;
    uint first_word;
    uint word_count;
    uint first_index; // of the first word's voxels
};
GPU_KERNEL(update, emission_places, EmissionPlaces, EmissionPlacesParams, GPU_NO_CONSTANTS)

struct InsertParams // push constants of update/insert: one thread a record
{
    GPU_CONST_PTR(Layer) layers; // [layer_count]
    GPU_PTR(BrickEntry) bricks;
    GPU_PTR(uint) heads;             // [brick_capacity] cleared: record + 1 of the first layer's leaf
    GPU_PTR(LayerLink) links;        // [record_count]
    GPU_PTR(WorkItem) items;         // the touched nodes of each level, where its range begins
    GPU_PTR(BrickCounters) counters; // [1] cleared
    GPU_PTR(OverlayState) state;     // [1]
    GPU_PTR(LevelRange) ranges;      // [level_count] begin where there is room for the level, without nodes
    GPU_PTR(DispatchArgs) args;      // [level_count] one thread a node
    uint layer_count;
    uint record_count;
    uint brick_mask;
    uint level_count;
    uint max_groups_x;
};
#define UPDATE_INSERT_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(1, bool, carves, kCarves, false)      /* some layer does; then update/carve lists nodes */                \
    CONSTANT(2, bool, exposes, kExposes, false)    /* and the base tree is filled */
GPU_KERNEL(update, insert, Insert, InsertParams, UPDATE_INSERT_CONSTANTS)

struct CarveParams // push constants of update/carve: a thread an entry of the table
{
    GPU_PTR(BrickEntry) bricks;      // [brick_mask + 1] as update/insert leaves them
    GPU_CONST_PTR(Node) nodes;       // of the base tree
    GPU_PTR(WorkItem) items;         // as in InsertParams, as the following ones
    GPU_PTR(BrickCounters) counters; // [1]
    GPU_PTR(OverlayState) state;     // [1]
    GPU_PTR(LevelRange) ranges;
    GPU_PTR(DispatchArgs) args;
    uint brick_mask;
    uint level_count;
    uint max_groups_x;
    uint base_root;
};
#define UPDATE_CARVE_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 0u) /* of the lists of a DAG, as base tree; 0: an octree */
GPU_KERNEL(update, carve, Carve, CarveParams, UPDATE_CARVE_CONSTANTS)

struct TopParams // push constants of update/top: one workgroup
{
    GPU_CONST_PTR(BrickEntry) bricks;
    GPU_CONST_PTR(WorkItem) items;
    GPU_CONST_PTR(LevelRange) ranges; // [level_count]
    GPU_CONST_PTR(BrickCounters) counters;
    GPU_PTR(TouchedNode) touched; // [brick_capacity]
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) node_attributes; // or null
    GPU_PTR(uint) counts;               // [node_capacity] children that the overlay has to hold for its nodes
    GPU_PTR(OverlayState) state;
    GPU_CONST_PTR(BeforeChild) before; // this and the next as in RankSource
    GPU_CONST_PTR(uint) voxels_before_leaf;
    GPU_PTR(BeforeChild) ranks; // by nodes of overlays; kRanks only
    uint brick_mask;
    uint base_root;  // node index; the node may be empty, and stands like a node of an overlay
    uint first_node; // of the overlay's region
    uint first_voxel;
    uint attribute_offset;  // modulo 2^32
    uint first_short_entry; // as in RankSource
    uint static_root;
};
#define UPDATE_TOP_CONSTANTS(CONSTANT)                                                                                 \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(1, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(2, uint, entries_per_word, kEntriesPerWord,                                                               \
             0u)                              /* of the lists of a DAG, as base tree; 0: it is an octree */            \
    CONSTANT(3, bool, carves, kCarves, false) /* some layer does */
GPU_KERNEL(update, top, Top, TopParams, UPDATE_TOP_CONSTANTS)

struct ExpandParams // push constants of update/expand: a workgroup for each touched node of the level above
{
    GPU_CONST_PTR(BrickEntry) bricks;
    GPU_CONST_PTR(WorkItem) items;
    GPU_CONST_PTR(LevelRange) ranges;
    GPU_PTR(TouchedNode) touched;
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) node_attributes; // or null
    GPU_PTR(uint) counts;               // [node_capacity] children that the overlay has to hold for its nodes
    GPU_PTR(uint) partials;             // [levels * ceil(node_capacity / kScanBlock)] cleared: sums of those
    GPU_PTR(OverlayState) state;
    GPU_CONST_PTR(BeforeChild) before; // this and the next as in RankSource
    GPU_CONST_PTR(uint) voxels_before_leaf;
    GPU_PTR(BeforeChild) ranks; // by nodes of overlays; kRanks only
    uint brick_mask;
    uint level;             // of the children
    uint first_node;        // of the overlay
    uint first_partial;     // of the level
    uint attribute_offset;  // modulo 2^32
    uint first_short_entry; // as in RankSource
    uint static_root;
};
#define UPDATE_EXPAND_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(1, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(2, uint, entries_per_word, kEntriesPerWord,                                                               \
             0u)                              /* of the lists of a DAG, as base tree; 0: it is an octree */            \
    CONSTANT(3, bool, leaves, kLeaves, false) /* the children are leaves, of a DAG */                                  \
    CONSTANT(4, bool, carves, kCarves, false) /* some layer does */
GPU_KERNEL(update, expand, Expand, ExpandParams, UPDATE_EXPAND_CONSTANTS)

struct OverlayAssignParams // push constants of update/assign
{
    GPU_PTR(Node) nodes;
    GPU_CONST_PTR(uint) counts;
    GPU_CONST_PTR(uint) partials; // exclusive prefix sums
    GPU_CONST_PTR(OverlayState) state;
    uint level;
    uint first_node;
    uint first_voxel;
    uint first_partial;
};
GPU_KERNEL(update, assign, Assign, OverlayAssignParams, GPU_NO_CONSTANTS)

/// The tables and sums that merging reads.
struct MergeView
{
    GPU_CONST_PTR(SceneView) scene;            // for the tables of sRGB codes
    GPU_CONST_PTR(VoxelSums) sums;             // of the base tree's voxels; kMergeAverage only
    GPU_CONST_PTR(EmissionSums) emission_sums; // of its emissive voxels; kMergeAverage only
    uint base_shift;                           // bits that these sums have more than those of the layers
    uint base_voxel_count; // voxels that have sums: others, which a brush has changed, count as nothing
};
GPU_BUFFER(MergeView, 8);

// The constants of every kernel with update/merge.glsl.
#define MERGE_CONSTANTS(CONSTANT)                                                                                      \
    CONSTANT(0, MergeRule, merge, kMerge, kMergeAverage)                                                               \
    CONSTANT(1, bool, emits, kEmits, false)                                                                            \
    CONSTANT(2, bool, ranks, kRanks, false)   /* the base tree is a DAG */                                             \
    CONSTANT(3, bool, carves, kCarves, false) /* some layer does */

struct MergeParams // push constants of update/merge and update/merge_emission
{
    GPU_CONST_PTR(MergeView) view;
    GPU_CONST_PTR(WorkItem) items;
    GPU_CONST_PTR(LevelRange) ranges;
    GPU_CONST_PTR(TouchedNode) touched;
    GPU_CONST_PTR(uint) heads;
    GPU_CONST_PTR(LayerLink) links;
    GPU_CONST_PTR(Layer) layers;
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) leaf_groups; // of an octree
    GPU_CONST_PTR(BeforeChild) ranks; // by nodes of overlays; kRanks only
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_PTR(Attribute) attributes;
    GPU_PTR(uvec2) emission_words; // the overlay's bits cleared; or null
    GPU_PTR(uint) emission;        // or null
    GPU_PTR(OverlayState) state;
    uint sum_shift;
    uint attribute_offset; // modulo 2^32
};
GPU_KERNEL(update, merge, Merge, MergeParams, MERGE_CONSTANTS)
GPU_KERNEL(update, merge_emission, MergeEmission, MergeParams, MERGE_CONSTANTS)

struct OverlayAverageParams // push constants of update/average: kLanes threads a touched node
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(WorkItem) items;
    GPU_CONST_PTR(LevelRange) ranges;
    GPU_CONST_PTR(TouchedNode) touched;
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Attribute) children; // of voxels for leaves, else of nodes
    GPU_PTR(Attribute) averages;       // of nodes
    GPU_CONST_PTR(OverlayState) state;
    uint item_range;
    uint children_offset;  // from a node's base to children
    uint attribute_offset; // from a node to averages
};
#define UPDATE_AVERAGE_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, uint, lanes, kLanes, 1u)                                                                               \
    CONSTANT(1, uint, local_size_x, kLocalSizeX, 1u) /* kNodesGroup * lanes */
GPU_KERNEL(update, average, Average, OverlayAverageParams, UPDATE_AVERAGE_CONSTANTS)

struct OverlayAverageTopParams // push constants of update/average_top: one workgroup
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(WorkItem) items;
    GPU_CONST_PTR(LevelRange) ranges;
    GPU_CONST_PTR(TouchedNode) touched;
    GPU_CONST_PTR(Node) nodes;
    GPU_PTR(Attribute) averages;              // of nodes
    GPU_CONST_PTR(Attribute) lowest_children; // attributes of the children of the lowest of these levels
    GPU_CONST_PTR(OverlayState) state;
    uint level_count;      // of nodes in all
    uint lowest_offset;    // from a child's number to lowest_children
    uint attribute_offset; // from a node to averages
};
#define UPDATE_AVERAGE_TOP_CONSTANTS(CONSTANT)                                                                         \
    CONSTANT(0, uint, lanes, kLanes, 1u)                                                                               \
    CONSTANT(1, uint, local_size_x, kLocalSizeX, 1u)
GPU_KERNEL(update, average_top, AverageTop, OverlayAverageTopParams, UPDATE_AVERAGE_TOP_CONSTANTS)

struct FinishParams // push constants of update/finish
{
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) node_attributes; // or null
    GPU_CONST_PTR(BrickCounters) counters;
    GPU_CONST_PTR(OverlayState) state;
    GPU_PTR(UpdateStatus) results; // copies that the host can read
    GPU_PTR(uint) roots;           // of updates of which the host does not know yet whether they failed
    uint root;                     // of the overlay
    uint last_root;                // the one that stays if the update failed, or kNoNode: roots[last_slot]
    uint last_slot;
    uint slot;      // element of roots and of results for this update
    uint sum_shift; // of the layers
    uint attribute_offset;
};
#define UPDATE_FINISH_CONSTANTS(CONSTANT) CONSTANT(0, bool, attributes, kAttributes, false)
GPU_KERNEL(update, finish, Finish, FinishParams, UPDATE_FINISH_CONSTANTS)

struct ShowParams // push constants of update/show
{
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) node_attributes; // or null
    GPU_CONST_PTR(uint) roots;
    uint root; // or kNoNode: roots[slot]
    uint slot;
    uint attribute_offset;
};
#define UPDATE_SHOW_CONSTANTS(CONSTANT) CONSTANT(0, bool, attributes, kAttributes, false)
GPU_KERNEL(update, show, Show, ShowParams, UPDATE_SHOW_CONSTANTS)

GPU_NAMESPACE_END

#endif
