// SPDX-License-Identifier: MIT
// Voxels by bricks: what its kernels share with the host. A brick is the block of 16^3 cells of a node above the
// leaves. Triangles are divided into items first, each in one brick and of few columns, so that threads have even work
// (binning, as in J. Pantaleoni, VoxelPipe, 2011, and S. Laine and T. Karras, High-Performance Software Rasterization
// on GPUs, 2011). Of voxels that several fragments share, the mixed ones, sums are kept.
#ifndef ZVO_SHADERS_VOXELIZE_BRICKS_H
#define ZVO_SHADERS_VOXELIZE_BRICKS_H

#include "octree/octree.h"
#include "voxelize/voxelize.h"

GPU_NAMESPACE_BEGIN

const uint kBrickLog2 = 4u;    // a brick has 16 cells along each axis
const uint kBrickLeaves = 64u; // leaves of a brick
const uint kBrickVoxels = 4096u;
const uint kLeafMaskWords = 128u; // words of the masks of a brick's leaves
const uint kFillLanes = 8u;       // threads of voxelize/fill that share a column of bricks: each takes 32 of its lines
const uint kFillPlanesMax = 25u;  // planes of crossings, so that counts of them have 32 bits
const uint kFillAxes = 3u;        // along which lines go for kFillRobust: y, z and x; for others only y
const uint kFacesWords = 4u;      // with kFillRobust, behind a brick's crossings: what voxelize/fill_vote gets
const uint kFillRounds = 4u;      // in which voxels and their neighbours in a brick vote
const uint kItemColumns = 16u;    // columns of an item

// ItemVoxels::info until the voxels are known: the number of a tile of 4x4 columns, and what is added
const uint kOneColumn = 16u;      // one column of the tile, of a triangle that is too large for a walk over several
const uint kItemColumnShift = 5u; // its number, 4 bits
const uint kWholeBox = 1u << 9;   // instead: all of a small triangle's box in the brick

const uint kBlockBricksLog2 = 3u;     // least log2 of the rows of bricks in a LargeBlock, which has as many columns
const uint kBlockLog2Max = 6u;        // greatest log2 of these rows: kBlocksMax such blocks cover the largest grid
const uint kBlocksMax = 16384u;       // blocks of a triangle: one thread lists them
const uint kBlocksListMax = 1u << 28; // blocks that one run may list
const uint kBlockLog2Shift = 28u;     // first bit of the log2 in LargeBlock::block

const uint kLargeGroup = 64u;  // threads of a workgroup of voxelize/bin_large
const uint kListGroup = 64u;   // threads of a workgroup of voxelize/list_bricks
const uint kListItems = 16u;   // table entries that a thread of it reads
const uint kItemsGroup = 64u;  // threads of a workgroup where one thread takes one item
const uint kBricksGroup = 64u; // threads of a workgroup where threads take bricks

const int kBrickLatticeLog2 = kVoxelLatticeLog2 + int(kBrickLog2); // lattice units of a brick's edge

/// A triangle that may have voxels, computed once for all that need it. Coordinates are those of voxelize/raster.glsl.
struct TriangleSetup
{
    ivec3 u; // lattice coordinates of the three corners
    ivec3 v;
    ivec3 w;
    uvec4 normals;    // of the vertices, of length 32767: nine numbers of 16 bits, with the next word
    uint last_normal; // the ninth
    uint material;
    uint flags; // voxelize/setup.glsl
};
GPU_BUFFER(TriangleSetup, 16);

/// What the fragments of a triangle with a texture, or with colours of its vertices, need beside TriangleSetup. Where a
/// scene emits light, a triangle has two: the second one is that of its emission's texture.
struct SurfaceSetup
{
    ivec3 uv_u; // texture coordinates of the vertices, 16.16
    ivec3 uv_v;
    uint level;    // in SceneView::levels: of the texture, as suits the triangle
    uvec4 colors;  // of the first two vertices
    uvec2 color_2; // of the third
    uvec3 zero;    // to whole texels of four words
};
GPU_BUFFER(SurfaceSetup, 16);

/// The words of a brick's crossings, with that many planes of them each way: of kFillAxes axes where it is robust. With
/// centres, as many follow of the crossings above voxels' centres.
GPU_FUNCTION uint fillWords(uint planes, bool robust, bool centres)
{
    uint axis_words = (centres ? 4u : 2u) * planes * kLeafMaskWords;
    return robust && planes != 0u ? kFillAxes * axis_words + kFacesWords : axis_words;
}

/// Up to kItemColumns columns of a triangle in a brick: of a small triangle, all that have voxels there; of a large
/// one, one of the 4x4 tiles of 4x4 columns of the brick.
struct BrickItem
{
    uint triangle; // its setup
    uint entry;    // of the brick in the table
};
GPU_BUFFER(BrickItem, 4);

/// A block of rows and columns of bricks that a large triangle's box touches.
struct LargeBlock
{
    uint triangle; // its setup
    uint block; // row by row, in the projection along the triangle's major axis | log2 of its rows << kBlockLog2Shift
};
GPU_BUFFER(LargeBlock, 4);

/// The voxels of an item. columns: those of its box, row by row, that have one. Coordinates are modulo a brick.
///
///     info | columns 16 | width - 1 4 | first u 4 | first v 4 | axis 2 | u mirrored 1 | v mirrored 1 |   from bit 0 on
///
/// With conservative coverage a second one follows, of which layers_lo and layers_hi are the columns' last layers.
struct ItemVoxels
{
    uint info;      // until voxelize/cover has found the voxels, see kOneColumn
    uint layers_lo; // 4 bits for each column: the first voxel's layer
    uint layers_hi;
};
GPU_BUFFER(ItemVoxels, 4);

const uint kNoRange = ~0u; // in the place of a brick's number: a full one, which no triangle may touch

/// A brick that triangles may touch.
struct BrickRange
{
    uint entry;       // in the brick table
    uint voxels;      // in it
    uint first_voxel; // of the octree
    uint first_sums;  // of its mixed voxels
};
GPU_BUFFER(BrickRange, 16);

/// Counts of one run. Counting goes on past a capacity.
struct BinCounters
{
    uint brick_count;
    uint fits;         // 1: everything had room; else the run is thrown away
    uint listed_count; // bricks; 0 in a run that is thrown away
    uint item_count;
    uint item_carry;    // how often that wrapped around
    uint known_items;   // those whose voxels voxelize/bin has found, which come first
    uint covered_items; // item_count; 0 in a run that is thrown away
    uint setup_count;
    uint blocks_exceeded; // 1: large triangles have more than kBlocksListMax blocks in all
    uint large_count;     // blocks of large triangles
    uint overflow_count;  // bricks that found no slot in the table
    uint nonfinite;
    uint out_of_range;
    uint outside;
    uint zero_area;
    uint leaf_count;
    uint voxel_count;
    uint voxel_carry;
    uint mixed_count;        // mixed voxels
    uint crossings_exceeded; // 1: more crossings in a voxel, or above one, than planes count
    uint open_lines;         // lines of voxels' centres that are inside behind all triangles
    uint filled_lo;          // voxels that are inside and not on the surface, in bricks
    uint filled_hi;
    uint undecided_lo; // voxels in bricks of which rays and neighbours say both
    uint undecided_hi;
    uint arrived;         // threads of the running dispatch (lib/arrivals.glsl); 0 in between
    DispatchArgs large;   // of voxelize/bin_large
    DispatchArgs known;   // of voxelize/cover for items whose voxels are known
    DispatchArgs cover;   // for the others
    DispatchArgs collect; // of voxelize/collect_bricks
    DispatchArgs fill;    // of voxelize/fill
    DispatchArgs vote;    // of voxelize/fill_vote
    DispatchArgs leaves;  // of kBrickLanes threads for each listed brick, and one workgroup at least
};
GPU_BUFFER(BinCounters, 4);

struct BinParams // push constants of voxelize/bin: a thread a triangle
{
    GPU_CONST_PTR(SceneView) scene; // [1]
    GPU_CONST_PTR(Chunk) chunks;    // [chunk_count]
    GPU_PTR(TriangleSetup) setups;  // [setup_capacity]
    GPU_PTR(SurfaceSetup) surfaces; // [setup_capacity], twice with kEmits; empty: no textures, no vertex colours
    GPU_PTR(BrickEntry) bricks;     // [brick_mask + 1]
    GPU_PTR(BrickItem) items;       // [item_capacity]
    GPU_PTR(ItemVoxels) voxels;     // [item_capacity], with conservative coverage twice as many
    GPU_PTR(LargeBlock) large;      // [large_capacity]
    GPU_PTR(BinCounters) counters;  // [1]
    vec3 origin;                    // world position of the grid's minimum corner
    float lattice_scale;            // lattice units per world unit
    ivec3 lattice_offset;           // is added to lattice positions
    uint window;                    // depth of the grid, and which cube of it is voxelized (voxelize/window.h)
    uint brick_mask;
    uint chunk_count;
    uint setup_capacity;
    uint large_capacity;
    uint item_capacity;
};
#define VOXELIZE_BIN_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, single, kSingle, false)       /* a chunk is one triangle, and a thread takes it */               \
    CONSTANT(2, uint, block_lanes, kBlockLanes, 1u) /* threads that share a block of a large triangle */               \
    CONSTANT(3, MaterialClass, material_class, kMaterialClass, kClassPlain)                                            \
    CONSTANT(4, Coverage, coverage, kCoverage, kCoverageConservative)                                                  \
    CONSTANT(5, RasterMode, mode, kMode, kModeCoverage) /* or kModeAttributes: fragments will be shaded */             \
    CONSTANT(6, bool, emits, kEmits, false)                                                                            \
    CONSTANT(7, bool, keeps_setups, kKeepsSetups, false) /* of small triangles with items: later kernels need them */
GPU_KERNEL(voxelize, bin, Bin, BinParams, VOXELIZE_BIN_CONSTANTS)

struct BinLargeParams // push constants of voxelize/bin_large: kBlockLanes threads a block
{
    GPU_CONST_PTR(TriangleSetup) setups; // [setup_capacity]
    GPU_CONST_PTR(LargeBlock) large;     // [large_capacity]
    GPU_PTR(BrickEntry) bricks;          // [brick_mask + 1]
    GPU_PTR(BrickItem) items;            // [item_capacity]
    GPU_PTR(ItemVoxels) voxels;          // [item_capacity], with conservative coverage twice as many
    GPU_PTR(BinCounters) counters;       // [1]
    uint window;
    uint brick_mask;
    uint setup_capacity;
    uint large_capacity;
    uint item_capacity;
};
#define VOXELIZE_BIN_LARGE_CONSTANTS(CONSTANT)                                                                         \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, uint, block_lanes, kBlockLanes, 1u)                                                                    \
    CONSTANT(2, Coverage, coverage, kItemCoverage, kCoverageConservative)
GPU_KERNEL(voxelize, bin_large, BinLarge, BinLargeParams, VOXELIZE_BIN_LARGE_CONSTANTS)

struct ListBricksParams // push constants of voxelize/list_bricks; counts of other kernels name its capacities
{
    GPU_PTR(BrickEntry) bricks;    // [brick_capacity]
    GPU_PTR(BrickRange) ranges;    // [range_capacity]
    GPU_PTR(BinCounters) counters; // [1]
    uint brick_capacity;
    uint max_groups_x;
    uint range_capacity;
    uint setup_capacity;
    uint item_capacity;
    uint large_capacity;
    uint fill_lanes; // threads of voxelize/fill a brick
};
#define VOXELIZE_LIST_BRICKS_CONSTANTS(CONSTANT) CONSTANT(0, uint, brick_lanes, kBrickLanes, 2u)
GPU_KERNEL(voxelize, list_bricks, ListBricks, ListBricksParams, VOXELIZE_LIST_BRICKS_CONSTANTS)

struct CoverParams // push constants of voxelize/cover: a thread an item
{
    GPU_CONST_PTR(SceneView) scene;       // [1]
    GPU_CONST_PTR(TriangleSetup) setups;  // [setup_capacity]
    GPU_CONST_PTR(SurfaceSetup) surfaces; // as in BinParams
    GPU_CONST_PTR(BrickEntry) bricks;     // [brick_capacity]
    GPU_CONST_PTR(BrickItem) items;       // [item_capacity]
    GPU_PTR(ItemVoxels) voxels;           // [item_capacity], with conservative coverage twice as many
    GPU_PTR(uint) masks;                  // kLeafMaskWords a range, of leaves; with kMixed as many, of mixed voxels
    GPU_PTR(uint)
    crossings; // fillWords() a range: kLeafMaskWords a plane, 2 kFillPlanes planes an axis: bits of the counts of
               // triangles that face up, from the lowest on, then of those that face down
    GPU_PTR(BinCounters) counters; // [1]
    uint window;
};
#define VOXELIZE_COVER_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, mixed, kMixed, false)                                                                            \
    CONSTANT(2, bool, known, kKnown, false) /* items whose voxels are known; else the others */                        \
    CONSTANT(3, MaterialClass, material_class, kMaterialClass, kClassPlain)                                            \
    CONSTANT(4, Coverage, coverage, kCoverage, kCoverageConservative)                                                  \
    CONSTANT(5, bool, emits, kEmits, false)                                                                            \
    CONSTANT(6, uint, fill_planes, kFillPlanes, 0u) /* 0: nothing is filled */                                         \
    CONSTANT(7, bool, robust, kRobust, false)       /* along kFillAxes axes */                                         \
    CONSTANT(8, bool, centres, kCentres, false)     /* those above centres are counted, too; not with kRobust */
GPU_KERNEL(voxelize, cover, Cover, CoverParams, VOXELIZE_COVER_CONSTANTS)

struct FillColumnsParams // push constants of voxelize/fill_columns: a thread a brick
{
    GPU_PTR(BrickEntry) bricks;       // [brick_mask + 1] get the columns of bricks (voxelize/fill_columns.glsl)
    GPU_CONST_PTR(BrickRange) ranges; // [range_capacity]
    GPU_PTR(BinCounters) counters;    // [1]
    uint window;
    uint brick_mask;
};
#define VOXELIZE_FILL_COLUMNS_CONSTANTS(CONSTANT)                                                                      \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, robust, kRobust, false)
GPU_KERNEL(voxelize, fill_columns, FillColumns, FillColumnsParams, VOXELIZE_FILL_COLUMNS_CONSTANTS)

struct FillParams // push constants of voxelize/fill: kFillLanes threads a brick, and axis
{
    GPU_PTR(BrickEntry) bricks;       // [brick_mask + 1] get the open bricks
    GPU_CONST_PTR(BrickRange) ranges; // [range_capacity]
    GPU_PTR(uint)
    crossings;                     // as in CoverParams; the first plane of a range becomes the masks of what is inside;
                                   // of kFillRobust, the first planes of each axis and way what rays that way say
    GPU_PTR(uint) masks;           // as in CoverParams; with kCentres they lose what is not inside
    GPU_PTR(BinCounters) counters; // [1]
    uint window;
    uint brick_mask;
};
#define VOXELIZE_FILL_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, uint, fill_planes, kFillPlanes, 1u)                                                                    \
    CONSTANT(2, Fill, fill, kFill, kFillSolid)                                                                         \
    CONSTANT(3, bool, centres, kCentres, false) /* voxels of the surface are inside by their centres, too */           \
    CONSTANT(4, bool, mixed, kMixed, false)
GPU_KERNEL(voxelize, fill, FillVoxels, FillParams, VOXELIZE_FILL_CONSTANTS)

struct FillVoteParams // push constants of voxelize/fill_vote: a workgroup of kBrickLeaves threads a brick
{
    GPU_PTR(BrickEntry) bricks;       // [brick_mask + 1] get the open bricks
    GPU_CONST_PTR(BrickRange) ranges; // [range_capacity]
    GPU_CONST_PTR(uint) masks;        // as in CoverParams
    GPU_PTR(uint) crossings;       // as voxelize/fill leaves them; the first plane becomes the masks of what is inside
    GPU_PTR(BinCounters) counters; // [1]
    uint window;
    uint brick_mask;
};
#define VOXELIZE_FILL_VOTE_CONSTANTS(CONSTANT)                                                                         \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, mixed, kMixed, false)                                                                            \
    CONSTANT(2, uint, fill_planes, kFillPlanes, 1u)
GPU_KERNEL(voxelize, fill_vote, FillVote, FillVoteParams, VOXELIZE_FILL_VOTE_CONSTANTS)

struct FillNodesParams // push constants of voxelize/fill_nodes: a thread a node above bricks
{
    GPU_PTR(BrickEntry) bricks;       // [brick_mask + 1] masks get the children that are full: they have no entries
    GPU_CONST_PTR(WorkItem) items;    // [nodes]
    GPU_CONST_PTR(LevelRange) ranges; // [kNodeLevelsMax]
    GPU_PTR(BrickCounters) counters;  // [1]
    uint window;
    uint brick_mask;
    uint height; // of the nodes' level; of bricks: 0
};
#define VOXELIZE_FILL_NODES_CONSTANTS(CONSTANT)                                                                        \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, robust, kRobust, false)
GPU_KERNEL(voxelize, fill_nodes, FillNodes, FillNodesParams, VOXELIZE_FILL_NODES_CONSTANTS)

struct CollectBricksParams // push constants of voxelize/collect_bricks: a thread a brick
{
    GPU_PTR(BrickEntry) bricks;    // [brick_capacity] get the masks of their leaves
    GPU_PTR(BrickRange) ranges;    // [range_capacity] get their voxels and first sums
    GPU_CONST_PTR(uint) masks;     // as in CoverParams
    GPU_CONST_PTR(uint) crossings; // as voxelize/fill leaves them
    GPU_PTR(WorkItem) work;        // [brick_capacity] bricks with voxels
    GPU_PTR(uint) work_bricks;     // [range_capacity] their numbers in ranges
    GPU_PTR(BinCounters) counters; // [1]
    GPU_PTR(BrickCounters) nodes;  // [1]
    GPU_PTR(LevelRange) levels;    // [kNodeLevelsMax] element 0 is set
    GPU_PTR(DispatchArgs) args;    // [kNodeLevelsMax] element 0 is set
    uint max_groups_x;
};
#define VOXELIZE_COLLECT_BRICKS_CONSTANTS(CONSTANT)                                                                    \
    CONSTANT(0, bool, mixed, kMixed, false)                                                                            \
    CONSTANT(1, uint, brick_lanes, kBrickLanes, 2u) /* threads that share a brick */                                   \
    CONSTANT(2, uint, fill_words, kFillWords, 0u)   /* of a range's crossings; 0: nothing is filled */
GPU_KERNEL(voxelize, collect_bricks, CollectBricks, CollectBricksParams, VOXELIZE_COLLECT_BRICKS_CONSTANTS)

struct PlaceBricksParams // push constants of voxelize/place_bricks: a thread a brick with voxels
{
    GPU_CONST_PTR(BrickEntry) bricks; // [brick_capacity]
    GPU_CONST_PTR(BrickRange) ranges; // [range_capacity]
    GPU_CONST_PTR(WorkItem) work;     // [brick_count] bricks with voxels
    GPU_CONST_PTR(uint) work_bricks;  // [brick_count] their numbers in ranges
    GPU_PTR(uint) order;              // [nodes of bricks] numbers in ranges, in the order of nodes
    GPU_PTR(uint) partials;           // [ceil(nodes / kScanBlock)] cleared: voxels of kScanBlock bricks each
    uint first_node;
    uint brick_count;
};
#define VOXELIZE_PLACE_BRICKS_CONSTANTS(CONSTANT) CONSTANT(0, bool, wide_keys, kWideKeys, false)
GPU_KERNEL(voxelize, place_bricks, PlaceBricks, PlaceBricksParams, VOXELIZE_PLACE_BRICKS_CONSTANTS)

struct BrickBasesParams // push constants of voxelize/brick_bases
{
    GPU_PTR(BrickRange) ranges;   // [range_capacity] get their first voxels
    GPU_CONST_PTR(uint) order;    // [brick_count] or kNoRange
    GPU_CONST_PTR(uint) partials; // [ceil(brick_count / kScanBlock)]
    uint is_scanned;              // 1: partials are exclusive prefix sums already
    uint brick_count;
};
GPU_KERNEL(voxelize, brick_bases, BrickBases, BrickBasesParams, GPU_NO_CONSTANTS)

struct BrickLeavesParams // push constants of voxelize/brick_leaves: kBrickLanes threads a brick
{
    GPU_CONST_PTR(BrickEntry) bricks; // [brick_capacity]
    GPU_CONST_PTR(BrickRange) ranges; // [range_capacity]
    GPU_CONST_PTR(uint) order;        // [brick_count] or kNoRange
    GPU_CONST_PTR(uint) masks;        // as in CoverParams
    GPU_CONST_PTR(uint) crossings;    // as voxelize/fill leaves them
    GPU_PTR(Node) nodes;              // [nodes of the octree] leaves have the masks of the surface
    GPU_PTR(MixedVoxels) mixed;       // [leaves] with kMixed
    GPU_PTR(uvec2) occupied;          // [leaves] with kFillWords: the masks of surface and inside
    uint first_leaf;                  // of nodes
    uint brick_count;
};
#define VOXELIZE_BRICK_LEAVES_CONSTANTS(CONSTANT)                                                                      \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, mixed, kMixed, false)                                                                            \
    CONSTANT(2, uint, brick_lanes, kBrickLanes, 2u)                                                                    \
    CONSTANT(3, uint, fill_words, kFillWords, 0u)
GPU_KERNEL(voxelize, brick_leaves, BrickLeaves, BrickLeavesParams, VOXELIZE_BRICK_LEAVES_CONSTANTS)

struct AttributesParams // push constants of voxelize/attributes: a thread an item
{
    GPU_CONST_PTR(SceneView) scene;       // [1]
    GPU_CONST_PTR(TriangleSetup) setups;  // [setup_capacity]
    GPU_CONST_PTR(SurfaceSetup) surfaces; // as in BinParams
    GPU_CONST_PTR(BrickEntry) bricks;     // [brick_capacity]
    GPU_CONST_PTR(BrickItem) items;       // [item_capacity]
    GPU_CONST_PTR(ItemVoxels) voxels;     // [item_capacity], with conservative coverage twice as many
    GPU_CONST_PTR(Node) nodes;            // [nodes of the octree], or of a layer
    GPU_CONST_PTR(MixedVoxels) mixed;     // [leaves] with kMixed
    GPU_PTR(VoxelSums) sums;              // [voxels], or with kMixed [mixed voxels]
    GPU_PTR(Attribute) attributes;        // [voxels] with kMixed, of those that are not mixed
    GPU_PTR(uvec2) emission_words;        // [ceil(voxels / 32)] with kEmits
    GPU_PTR(EmissionSums) emission_sums;  // [emissive voxels]
    GPU_CONST_PTR(BinCounters) counters;  // [1]
    uint window;
    uint first_leaf;
    uint first_item; // of this dispatch
    uint item_end;
    uint sum_shift;
};
#define VOXELIZE_ATTRIBUTES_CONSTANTS(CONSTANT)                                                                        \
    CONSTANT(0, bool, wide_keys, kWideKeys, false)                                                                     \
    CONSTANT(1, bool, mixed, kMixed, false)                                                                            \
    CONSTANT(2, MaterialClass, material_class, kMaterialClass, kClassPlain)                                            \
    CONSTANT(3, Coverage, coverage, kCoverage, kCoverageConservative)                                                  \
    CONSTANT(4, RasterMode, mode, kMode, kModeAttributes) /* or kModeEmission */                                       \
    CONSTANT(5, bool, emits, kEmits, false)                                                                            \
    CONSTANT(6, bool, centres, kCentres, false) /* not all voxels of the surface are there */
GPU_KERNEL(voxelize, attributes, Attributes, AttributesParams, VOXELIZE_ATTRIBUTES_CONSTANTS)
GPU_KERNEL(voxelize, attributes_int64, AttributesInt64, AttributesParams, VOXELIZE_ATTRIBUTES_CONSTANTS)

struct ResolveLeavesParams // push constants of voxelize/resolve_leaves: a thread a leaf
{
    GPU_CONST_PTR(SceneView) scene;   // [1]
    GPU_CONST_PTR(Node) nodes;        // [nodes of the octree]
    GPU_CONST_PTR(MixedVoxels) mixed; // [leaf_count]
    GPU_CONST_PTR(VoxelSums) sums;    // [mixed voxels]
    GPU_PTR(Attribute) attributes;    // [voxels] of mixed ones
    GPU_PTR(uint) max_fragments;      // [1] raised to the largest fragment count of a voxel
    uint first_leaf;
    uint leaf_count;
    uint sum_shift;
};
GPU_KERNEL(voxelize, resolve_leaves, ResolveLeaves, ResolveLeavesParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
