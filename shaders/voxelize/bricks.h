// SPDX-License-Identifier: MIT
// Voxels by bricks: what its kernels share with the host. A brick is the block of 16^3 cells of a node above the
// leaves. Triangles are sorted into bricks first; then a workgroup owns a brick, with its masks and sums in shared
// memory (sort-middle: J. Pantaleoni, VoxelPipe, 2011; S. Laine and T. Karras, High-Performance Software Rasterization
// on GPUs, 2011).
#ifndef ZVO_SHADERS_VOXELIZE_BRICKS_H
#define ZVO_SHADERS_VOXELIZE_BRICKS_H

#include "octree/octree.h"
#include "voxelize/voxelize.h"

GPU_NAMESPACE_BEGIN

const uint kBrickLog2 = 4u;      // a brick has 16 cells along each axis
const uint kBrickLeaves = 64u;   // leaves of a brick
const uint kBrickWords = 128u;   // words of the masks of a brick's leaves
const uint kItemColumns = 16u;   // columns of an item: at most one voxel of thin coverage each
const uint kWholeBox = 16u;      // BrickItem: all of the triangle's box in the brick; less: the number of a tile
const uint kItemTileShift = 27u; // of BrickItem::draw
const uint kBlockBricks = 8u;    // rows and columns of bricks in a block of a large triangle
const uint kBlocksMax = 16384u;  // of a triangle: one thread lists them
const uint kLargeGroup = 64u;    // threads of a workgroup of voxelize/bin_large
const uint kListGroup = 64u;     // threads of a workgroup of voxelize/list_bricks
const uint kListItems = 16u;     // table entries that a thread of it reads
const uint kUnitsMax = 16384u;   // of a brick: one thread lists them
const uint kBricksGroup = 64u;   // threads of a workgroup where one thread takes one brick
const int kBrickLatticeLog2 = kVoxelLatticeLog2 + int(kBrickLog2); // lattice units of a brick's edge

/// Up to kItemColumns columns of a triangle in a brick.
struct BrickItem
{
    uint draw; // | tile << kItemTileShift: one of the 4x4 tiles of 4x4 columns of the brick, or kWholeBox
    uint triangle;
};
GPU_BUFFER(BrickItem, 8);

/// A block of kBlockBricks rows and columns of bricks that a large triangle's box touches.
struct LargeBlock
{
    uint draw;
    uint triangle;
    uint block; // row by row, in the projection along the triangle's major axis
};
GPU_BUFFER(LargeBlock, 4);

/// The voxels of an item. columns: those of its box that have one, row by row.
///
///     info | columns 16 | width - 1 4 | first u 4 | first v 4 | axis 2 | u mirrored 1 | v mirrored 1 |   from bit 0 on
struct ItemVoxels
{
    uint info;
    uint layers_lo; // 4 bits for each column: the voxel's layer in the brick
    uint layers_hi;
};
GPU_BUFFER(ItemVoxels, 4);

/// A brick that triangles may touch.
struct BrickRange
{
    uint entry;       // in the brick table
    uint first;       // of its items
    uint count;       // of its items
    uint voxels;      // in it
    uint first_voxel; // of the octree
    uint first_sums;  // of its voxels, if the brick has several units
    uint units;       // workgroups that share it
    uint arrived;     // units that are done, of this pass and those before
};
GPU_BUFFER(BrickRange, 16);

/// What a workgroup takes of a brick. Few bricks have more than one unit.
struct BrickUnit
{
    uint brick; // in the list of ranges
    uint first; // of its items
    uint count; // of its items
    uint units; // of the brick
};
GPU_BUFFER(BrickUnit, 16);

/// Counts of one run. Counting goes on past a capacity.
struct BinCounters
{
    uint brick_count;
    uint listed_count; // bricks; 0 in a run that is thrown away, as something had no room
    uint item_count;
    uint item_carry; // how often that wrapped around
    uint unit_count;
    uint covered_units;  // unit_count; 0 in a run that is thrown away
    uint wide_count;     // what is too large for voxelization by bricks
    uint large_count;    // blocks of large triangles
    uint overflow_count; // bricks that found no slot in the table
    uint nonfinite;
    uint out_of_range;
    uint outside;
    uint zero_area;
    uint leaf_count;
    uint voxel_count;
    uint voxel_carry;
    uint summed_voxels;   // those of bricks with several units
    uint arrived;         // threads of the running dispatch (lib/arrivals.glsl); 0 in between
    DispatchArgs large;   // of voxelize/bin_large
    DispatchArgs cover;   // of voxelize/cover
    DispatchArgs collect; // of voxelize/collect_bricks
};
GPU_BUFFER(BinCounters, 4);

struct BinParams // push constants of voxelize/bin and voxelize/bin_large
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(Chunk) chunks;   // [chunk_count]
    GPU_PTR(BrickEntry) bricks;    // [brick_mask + 1]
    GPU_PTR(BrickItem) items;      // [item_capacity]
    GPU_PTR(LargeBlock) large;     // [large_capacity]
    GPU_PTR(BinCounters) counters; // [1]
    vec3 origin;                   // world position of the grid's minimum corner
    float lattice_scale;           // lattice units per world unit
    uint window;                   // depth of the grid, and which cube of it is voxelized (voxelize/window.h)
    uint brick_mask;
    uint chunk_count;
    uint large_capacity;
    uint item_capacity;
};
#define VOXELIZE_BIN_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, writes, kWrites, false)       /* items, which are only counted otherwise */                      \
    CONSTANT(2, bool, single, kSingle, false)       /* a chunk is one triangle, and a thread takes it */               \
    CONSTANT(3, uint, block_lanes, kBlockLanes, 1u) /* threads that share a block of a large triangle */
GPU_KERNEL(voxelize, bin, Bin, BinParams, VOXELIZE_BIN_CONSTANTS)
GPU_KERNEL(voxelize, bin_large, BinLarge, BinParams, VOXELIZE_BIN_CONSTANTS)

struct ListBricksParams // push constants of voxelize/list_bricks
{
    GPU_PTR(BrickEntry) bricks;    // [brick_capacity]
    GPU_PTR(BrickRange) ranges;    // [range_capacity]
    GPU_PTR(BrickUnit) units;      // [range_capacity + item_capacity / unit_items]
    GPU_PTR(uint) masks;           // [range_capacity * kBrickWords] cleared for bricks with several units
    GPU_PTR(BinCounters) counters; // [1]
    uint brick_capacity;
    uint max_groups_x;
    uint range_capacity;
    uint item_capacity;
    uint unit_items; // the most of a unit
    uint large_capacity;
};
GPU_KERNEL(voxelize, list_bricks, ListBricks, ListBricksParams, GPU_NO_CONSTANTS)

struct CoverParams // push constants of voxelize/cover: a workgroup a unit
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_PTR(BrickEntry) bricks;
    GPU_PTR(BrickRange) ranges;
    GPU_CONST_PTR(BrickUnit) units;
    GPU_CONST_PTR(BrickItem) items;
    GPU_PTR(ItemVoxels) voxels; // [items]
    GPU_PTR(uint) masks;        // [kBrickWords] for each range
    GPU_CONST_PTR(BinCounters) counters;
    vec3 origin;
    float lattice_scale;
    uint window;
};
#define VOXELIZE_COVER_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, uint, local_size_x, kLocalSizeX, 32u)                                                                  \
    CONSTANT(2, MaterialClass, material_class, kMaterialClass, kClassPlain)
GPU_KERNEL(voxelize, cover, Cover, CoverParams, VOXELIZE_COVER_CONSTANTS)

struct CollectBricksParams // push constants of voxelize/collect_bricks: a thread a brick
{
    GPU_CONST_PTR(BrickEntry) bricks;
    GPU_PTR(BrickRange) ranges;
    GPU_PTR(WorkItem) work;    // those with voxels
    GPU_PTR(uint) work_bricks; // their numbers in ranges
    GPU_PTR(BinCounters) counters;
    GPU_PTR(BrickCounters) nodes;
    GPU_PTR(LevelRange) levels; // element 0 is set
    GPU_PTR(DispatchArgs) args; // element 0 is set
    uint max_groups_x;
};
GPU_KERNEL(voxelize, collect_bricks, CollectBricks, CollectBricksParams, GPU_NO_CONSTANTS)

struct PlaceBricksParams // push constants of voxelize/place_bricks: a thread a brick with voxels
{
    GPU_CONST_PTR(BrickEntry) bricks;
    GPU_CONST_PTR(BrickRange) ranges;
    GPU_CONST_PTR(WorkItem) work;
    GPU_CONST_PTR(uint) work_bricks;
    GPU_PTR(uint) order;    // [brick_count] numbers in ranges, in the order of nodes
    GPU_PTR(uint) partials; // [ceil(brick_count / kScanBlock)] cleared: voxels of kScanBlock bricks each
    uint first_node;
    uint brick_count;
};
#define VOXELIZE_PLACE_BRICKS_CONSTANTS(CONSTANT) CONSTANT(0, bool, wide_keys, kWideKeys, false)
GPU_KERNEL(voxelize, place_bricks, PlaceBricks, PlaceBricksParams, VOXELIZE_PLACE_BRICKS_CONSTANTS)

struct BrickBasesParams // push constants of voxelize/brick_bases
{
    GPU_PTR(BrickRange) ranges; // get their first voxels
    GPU_CONST_PTR(uint) order;
    GPU_CONST_PTR(uint) partials;
    uint is_scanned; // 1: partials are exclusive prefix sums already
    uint brick_count;
};
GPU_KERNEL(voxelize, brick_bases, BrickBases, BrickBasesParams, GPU_NO_CONSTANTS)

struct AttributesParams // push constants of voxelize/attributes: a workgroup a unit
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(BrickEntry) bricks;
    GPU_PTR(BrickRange) ranges;
    GPU_CONST_PTR(BrickUnit) units; // [unit_count]
    GPU_CONST_PTR(BrickItem) items;
    GPU_CONST_PTR(ItemVoxels) voxels;
    GPU_CONST_PTR(uint) masks;
    GPU_PTR(VoxelSums) sums; // of the voxels of bricks with several units
    GPU_PTR(Node) nodes;
    GPU_PTR(Attribute) attributes; // [voxel_count]
    GPU_PTR(uint) max_fragments;   // [1] raised to the largest fragment count of a voxel
    vec3 origin;
    float lattice_scale;
    uint window;
    uint unit_count;
    uint sum_shift;
};
#define VOXELIZE_ATTRIBUTES_CONSTANTS(CONSTANT)                                                                        \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, uint, local_size_x, kLocalSizeX, 32u)                                                                  \
    CONSTANT(2, MaterialClass, material_class, kMaterialClass, kClassPlain)                                            \
    CONSTANT(3, uint, sum_voxels, kSumVoxels, 256u) /* of a brick whose sums are in shared memory at once */
GPU_KERNEL(voxelize, attributes, Attributes, AttributesParams, VOXELIZE_ATTRIBUTES_CONSTANTS)

GPU_NAMESPACE_END

#endif
