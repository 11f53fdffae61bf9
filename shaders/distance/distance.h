// SPDX-License-Identifier: MIT
// Distances of cells' centres to triangles, in a band around these (docs/voxelization.md, Distance): what the kernels
// share with the host. They take the items of a voxelization (voxelize/bricks.h) on a lattice of their own, of twice as
// many voxels an edge, in which the grid lies kBandMargin voxels from the lower faces, so that triangles beyond these
// count, too. Along y the triangles lie half a voxel higher: then the cells' centres are the upper ends of voxels,
// between which voxelize/fill finds what is inside.
#ifndef ZVO_SHADERS_DISTANCE_DISTANCE_H
#define ZVO_SHADERS_DISTANCE_DISTANCE_H

#include "voxelize/bricks.h"

GPU_NAMESPACE_BEGIN

const uint kBandMax = 15u; // voxels: distances within have 32 bits
const int kBandMargin = 16;
const int kBandMarginLattice = kBandMargin << kVoxelLatticeLog2;
const uint kDistanceBits = 8u;   // a squared distance counts 1 / (1 << kDistanceBits) of squared lattice units
const uint kNoDistance = ~0u;    // of a cell beyond the band
const uint kCentersInBand = 64u; // cells of a leaf

const uint kMeasureGroup = 64u; // threads of a workgroup
const uint kLeavesGroup = 64u;

/// A brick of 16^3 cells with leaves that the band may reach.
struct BandBrick
{
    uvec3 brick;  // its place among the bricks of the grid
    uint entry;   // in the brick table
    uint mask_lo; // its leaves
    uint mask_hi;
    uint first_leaf; // their number, once bricks are in order
};
GPU_BUFFER(BandBrick, 4);

/// A leaf: 4^3 cells.
struct BandLeaf
{
    uvec3 leaf;     // its place among the leaves of the grid
    uint inside_lo; // cells whose centres are inside
    uint inside_hi;
    uint in_band; // 1: some centre is in the band
};
GPU_BUFFER(BandLeaf, 4);

struct BandCounters
{
    uint brick_count;
    uint leaf_count;
    uint overflow_count; // bricks that found no slot in the table
};
GPU_BUFFER(BandCounters, 4);

struct MarkBandParams // push constants of distance/mark: a thread an item
{
    GPU_CONST_PTR(TriangleSetup) setups; // [setup_capacity]
    GPU_CONST_PTR(BrickItem) items;      // [item_capacity]
    GPU_CONST_PTR(ItemVoxels) voxels;    // [2 item_capacity]
    GPU_PTR(BrickEntry) bricks;          // [brick_mask + 1] get entries of the bricks in reach
    GPU_CONST_PTR(BinCounters) counters; // [1]
    GPU_PTR(BandCounters) band_counters; // [1]
    uint window;
    uint brick_mask;
    uint resolution; // of the grid
    uint band;       // voxels
};
#define DISTANCE_MARK_CONSTANTS(CONSTANT) CONSTANT(0, bool, wide_keys, kWideKeys, false)
GPU_KERNEL(distance, mark, MarkBand, MarkBandParams, DISTANCE_MARK_CONSTANTS)

struct ListBandParams // push constants of distance/list: a thread an entry of the table
{
    GPU_CONST_PTR(BrickEntry) bricks; // [brick_mask + 1]
    GPU_PTR(BandBrick) listed;        // [listed_capacity] in any order
    GPU_PTR(BandCounters) counters;   // [1]
    uint window;
    uint brick_mask;
    uint listed_capacity;
};
#define DISTANCE_LIST_CONSTANTS(CONSTANT) CONSTANT(0, bool, wide_keys, kWideKeys, false)
GPU_KERNEL(distance, list, ListBand, ListBandParams, DISTANCE_LIST_CONSTANTS)

struct PlaceBandParams // push constants of distance/place: a thread a brick
{
    GPU_PTR(BrickEntry) bricks;      // [brick_capacity] get the numbers of bricks in mask_lo
    GPU_CONST_PTR(BandBrick) listed; // [listed_count] in Morton order
    GPU_PTR(BandLeaf) leaves;        // [leaf_count]
    uint listed_count;
};
GPU_KERNEL(distance, place, PlaceBand, PlaceBandParams, GPU_NO_CONSTANTS)

struct MeasureParams // push constants of distance/measure: kLanes threads an item
{
    GPU_CONST_PTR(TriangleSetup) setups; // [setup_capacity]
    GPU_CONST_PTR(BrickItem) items;      // [item_count]
    GPU_CONST_PTR(ItemVoxels) voxels;    // [2 item_count]
    GPU_CONST_PTR(BrickEntry) bricks;    // [brick_mask + 1]
    GPU_CONST_PTR(BandBrick) listed;     // [listed_count]
    GPU_PTR(uint) bounds;                // [64 leaf_count] floats: no centre is farther away, in lattice units
    GPU_PTR(uint) squared;               // [64 leaf_count] with kExact: the distances
    uint window;
    uint brick_mask;
    uint item_count;
    uint resolution; // of the grid
    uint band;       // voxels
};
#define DISTANCE_MEASURE_CONSTANTS(CONSTANT)                                                                           \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, uint, lanes, kLanes, 8u)                                                                               \
    CONSTANT(2, bool, exact, kExact, false) /* else bounds alone */
GPU_KERNEL(distance, measure, Measure, MeasureParams, DISTANCE_MEASURE_CONSTANTS)

struct SignBandParams // push constants of distance/sign: a thread a leaf
{
    GPU_CONST_PTR(BrickEntry) bricks; // [brick_mask + 1]
    GPU_CONST_PTR(uint) crossings;    // as voxelize/fill leaves them
    GPU_CONST_PTR(uint) squared;      // [64 leaf_count]
    GPU_PTR(BandLeaf) leaves;         // [leaf_count]
    uint window;
    uint brick_mask;
    uint leaf_count;
    uint is_filled; // 0: nothing is inside
};
#define DISTANCE_SIGN_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, uint, fill_planes, kFillPlanes, 1u)
GPU_KERNEL(distance, sign, SignBand, SignBandParams, DISTANCE_SIGN_CONSTANTS)

struct KeepLeavesParams // push constants of distance/keep: a thread a cell
{
    GPU_CONST_PTR(uint) kept; // [leaf_count] numbers among all leaves
    GPU_CONST_PTR(BandLeaf) all_leaves;
    GPU_CONST_PTR(uint) all_squared;
    GPU_PTR(BandLeaf) leaves; // [leaf_count]
    GPU_PTR(uint) squared;    // [64 leaf_count]
    uint leaf_count;
};
GPU_KERNEL(distance, keep, KeepLeaves, KeepLeavesParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
