// SPDX-License-Identifier: MIT
// What the octree construction kernels share with the host.
#ifndef ZVO_SHADERS_OCTREE_OCTREE_H
#define ZVO_SHADERS_OCTREE_OCTREE_H

#include "shared/bricks.h"
#include "shared/octree.h"
#include "shared/scene.h"

GPU_NAMESPACE_BEGIN

const uint kCollectGroup = 64u; // threads of a workgroup of octree/collect
const uint kCollectItems = 16u; // table entries that a thread of it reads, at most 32
const uint kNodesGroup = 64u;   // threads of a workgroup where one thread takes one node
const uint kScanGroup = 64u;    // threads of a workgroup that scans: few, as barriers are expensive on CPUs
const uint kScanItems = 16u;    // elements a thread of such a workgroup takes
const uint kScanBlock = 1024u;  // elements a workgroup takes: kScanGroup * kScanItems

/// A node under construction: the numbers of its own and its parent's entry in the brick table.
struct WorkItem
{
    uint entry;
    uint parent_entry;
};
GPU_BUFFER(WorkItem, 4);

/// The work items of one level of nodes. Element 0 is for the leaves, the last one for the root.
struct LevelRange
{
    uint first;
    uint count;
};
GPU_BUFFER(LevelRange, 4);

struct CollectParams // push constants of octree/collect
{
    GPU_CONST_PTR(BrickEntry) bricks; // [brick_capacity], leaves only
    GPU_PTR(WorkItem) items;          // [brick_capacity]
    GPU_PTR(BrickCounters) counters;  // [1]
    uint brick_capacity;
};
GPU_KERNEL(octree, collect, Collect, CollectParams)

struct NextLevelParams // push constants of octree/next_level
{
    GPU_CONST_PTR(BrickCounters) counters;
    GPU_PTR(LevelRange) ranges; // [kNodeLevelsMax]
    GPU_PTR(DispatchArgs) args; // [kNodeLevelsMax] of each level, leaves first: for one thread an item
    uint height;                // 0: leaves
    uint max_groups_x;
};
GPU_KERNEL(octree, next_level, NextLevel, NextLevelParams)

struct ParentsParams // push constants of octree/parents
{
    GPU_PTR(BrickEntry) bricks;
    GPU_PTR(WorkItem) items;
    GPU_PTR(BrickCounters) counters;
    GPU_CONST_PTR(LevelRange) ranges;
    uint brick_mask;
    uint height; // 0: leaves
};
GPU_KERNEL_BEGIN(octree, parents, Parents, ParentsParams)
    GPU_CONSTANT(bool, wide_keys, false)
GPU_KERNEL_END

struct PlaceParams // push constants of octree/place
{
    GPU_PTR(BrickEntry) bricks;
    GPU_CONST_PTR(WorkItem) items;
    GPU_PTR(Node) nodes;
    uint first_item;
    uint node_count; // of the level
    uint is_root;
};
GPU_KERNEL_BEGIN(octree, place, Place, PlaceParams)
    GPU_CONSTANT(bool, wide_keys, false)
GPU_KERNEL_END

struct CountParams // push constants of octree/count
{
    GPU_CONST_PTR(Node) nodes;
    GPU_PTR(uint) partials; // [ceil(node_count / kScanBlock)]
    uint first_node;
    uint node_count;
};
GPU_KERNEL(octree, count, Count, CountParams)

struct ScanParams // push constants of octree/scan: an exclusive scan in place by one workgroup
{
    GPU_PTR(uint) values; // [count]
    GPU_PTR(uint) total;  // [1] sum of all values
    uint count;
};
GPU_KERNEL(octree, scan, Scan, ScanParams)

struct AssignParams // push constants of octree/assign
{
    GPU_PTR(Node) nodes;
    GPU_PTR(BrickEntry) bricks;
    GPU_CONST_PTR(uint) partials; // scanned
    uint first_node;
    uint node_count;
    uint first_child; // node index of the next level's first node; 0 in a leaf: voxels
    uint tell_bricks; // 1: write the first child to the nodes' entries in the brick table
};
GPU_KERNEL(octree, assign, Assign, AssignParams)

struct AverageParams // push constants of octree/average
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Attribute) children; // voxel attributes for leaves, else the node attributes
    GPU_PTR(Attribute) averages;       // [nodes of the octree]
    uint first_node;
    uint node_count;
};
GPU_KERNEL(octree, average, Average, AverageParams)

GPU_NAMESPACE_END

#endif
