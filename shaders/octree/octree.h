// SPDX-License-Identifier: MIT
// What the octree construction kernels share with the host.
#ifndef ZVO_SHADERS_OCTREE_OCTREE_H
#define ZVO_SHADERS_OCTREE_OCTREE_H

#include "shared/bricks.h"
#include "shared/octree.h"
#include "shared/scene.h"

GPU_NAMESPACE_BEGIN

const uint kNodesGroup = 64u;   // threads of a workgroup where one thread takes one node
const uint kScanGroup = 64u;    // threads of a workgroup that scans: few, as barriers are expensive on CPUs
const uint kScanItems = 16u;    // elements a thread of such a workgroup takes
const uint kScanBlock = 1024u;  // elements a workgroup takes: kScanGroup * kScanItems
const uint kRootGroup = 64u;    // threads of the only workgroup of a kernel that takes the root and its children
const uint kRootLevels = 2u;    // levels that it takes
const uint kAssignGroup = 128u; // threads of a workgroup of octree/assign
const uint kAssignItems = 8u;   // nodes that a thread of it takes: kScanBlock in all

/// The work items of one level of nodes. Element 0 of several is for the lowest level, the last one for the root.
struct LevelRange
{
    uint first;
    uint count;
};
GPU_BUFFER(LevelRange, 4);

struct ParentsParams // push constants of octree/parents
{
    GPU_PTR(BrickEntry) bricks;
    GPU_PTR(WorkItem) items;
    GPU_PTR(BrickCounters) counters;
    GPU_PTR(LevelRange) ranges; // [kNodeLevelsMax] cleared; element height + 1 is set
    GPU_PTR(DispatchArgs) args; // [kNodeLevelsMax] cleared; element height + 1 is set: for one thread an item
    uint brick_mask;
    uint height; // 0: the lowest level
    uint max_groups_x;
};
#define OCTREE_PARENTS_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */
GPU_KERNEL(octree, parents, Parents, ParentsParams, OCTREE_PARENTS_CONSTANTS)

struct NumberParams // push constants of octree/number: one workgroup, a thread a child of the root
{
    GPU_PTR(BrickEntry) bricks;
    GPU_CONST_PTR(WorkItem) items;
    GPU_CONST_PTR(LevelRange) ranges; // [level_count]
    GPU_PTR(Node) nodes;
    uint level_count;
    uint root_children; // nodes of the second level
};
#define OCTREE_NUMBER_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */
GPU_KERNEL(octree, number, Number, NumberParams, OCTREE_NUMBER_CONSTANTS)

struct PlaceParams // push constants of octree/place
{
    GPU_PTR(BrickEntry) bricks;
    GPU_CONST_PTR(WorkItem) items;
    GPU_PTR(Node) nodes;
    GPU_PTR(uint) partials; // [ceil(nodes of the level / kScanBlock)] cleared: children of kScanBlock nodes each
    uint first_item;
    uint first_node; // of the level
    uint item_count; // of the level: full nodes have no items
};
#define OCTREE_PLACE_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */
GPU_KERNEL(octree, place, Place, PlaceParams, OCTREE_PLACE_CONSTANTS)

struct ScanParams // push constants of octree/scan: an exclusive scan in place by one workgroup
{
    GPU_PTR(uint) values; // [count]
    GPU_PTR(uint) total;  // [1] sum of all values
    uint count;
};
GPU_KERNEL(octree, scan, Scan, ScanParams, GPU_NO_CONSTANTS)

struct AssignParams // push constants of octree/assign
{
    GPU_PTR(Node) nodes;
    GPU_CONST_PTR(uint) partials; // [ceil(node_count / kScanBlock)] children of kScanBlock nodes each
    uint is_scanned;              // 1: partials are exclusive prefix sums already
    uint first_node;
    uint node_count;
    uint first_child; // node index of the next level's first node
};
GPU_KERNEL(octree, assign, Assign, AssignParams, GPU_NO_CONSTANTS)

struct AverageParams // push constants of octree/average
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Attribute) children; // voxel attributes for leaves, else the node attributes
    GPU_PTR(Attribute) averages;       // [nodes of the octree]
    GPU_CONST_PTR(uvec2) leaf_groups;  // of leaf words
    uint first_node;
    uint node_count;
    uint reference;       // from the number of a node to its reference
    uint child_reference; // from the number of a child to its reference
};
#define OCTREE_AVERAGE_CONSTANTS(CONSTANT) CONSTANT(0, uint, lanes, kLanes, 1u)
GPU_KERNEL(octree, average, Average, AverageParams, OCTREE_AVERAGE_CONSTANTS)

struct InheritParams // push constants of octree/inherit: a thread a node of a level above leaves
{
    GPU_CONST_PTR(Node) nodes;
    GPU_PTR(Attribute) attributes; // [nodes of the octree]
    uint first_node;
    uint node_count;
};
GPU_KERNEL(octree, inherit, Inherit, InheritParams, GPU_NO_CONSTANTS)

struct LeafWordsParams // push constants of octree/leaf_words: a thread a node
{
    GPU_CONST_PTR(Node) from;
    GPU_CONST_PTR(uvec2) occupied; // [leaf_count] with kFilled
    GPU_PTR(Node) to;              // [ceil((2 * inner_count + leaf_count) / 2)] and with kFilled, what follows
    GPU_PTR(uvec2) surface;        // the same as words
    GPU_PTR(uvec2) leaf_groups;    // [kFirstLeafGroup + ceil((2 * inner_count + leaf_count) / kLeafGroup)]
    uint inner_count;
    uint leaf_count;
    uint first_parent;     // of leaves
    uint attribute_offset; // from the number of a node behind the pool to the index of its attributes, modulo 2^32
    uint first_full;       // with kFilled, the node of `to` from which the full nodes stand, then the surface masks
};
#define OCTREE_LEAF_WORDS_CONSTANTS(CONSTANT) CONSTANT(0, bool, filled, kFilled, false)
GPU_KERNEL(octree, leaf_words, LeafWords, LeafWordsParams, OCTREE_LEAF_WORDS_CONSTANTS)

struct AverageTopParams // push constants of octree/average_top: one workgroup
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(Node) nodes;
    GPU_PTR(Attribute) averages;              // [nodes of the octree]
    GPU_CONST_PTR(Attribute) lowest_children; // attributes of the children of the lowest of these levels
    GPU_CONST_PTR(uvec2) leaf_groups;         // of leaf words
    LevelRange levels[kRootLevels];           // the root, its children
    uint level_count;                         // 1 where the root's children are voxels
    uint leaf_level;                          // of the whole octree
    uint leaf_reference;                      // from the number of a leaf to its reference
};
#define OCTREE_AVERAGE_TOP_CONSTANTS(CONSTANT)                                                                         \
    CONSTANT(0, uint, lanes, kLanes, 1u)                                                                               \
    CONSTANT(1, uint, local_size_x, kLocalSizeX, 1u)
GPU_KERNEL(octree, average_top, AverageTop, AverageTopParams, OCTREE_AVERAGE_TOP_CONSTANTS)

GPU_NAMESPACE_END

#endif
