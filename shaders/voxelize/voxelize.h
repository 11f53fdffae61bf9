// SPDX-License-Identifier: MIT
// What the voxelization kernels share with the host.
#ifndef ZVO_SHADERS_VOXELIZE_VOXELIZE_H
#define ZVO_SHADERS_VOXELIZE_VOXELIZE_H

#include "shared/bricks.h"
#include "shared/octree.h"
#include "shared/scene.h"

GPU_ENUM(Coverage) // kCoverageConservative, kCoverageThin
#define GPU_TYPE_Coverage uint
GPU_ENUM(MaterialClass) // kClassPlain and so on
#define GPU_TYPE_MaterialClass uint
GPU_ENUM(RasterMode) // kModeCoverage and so on
#define GPU_TYPE_RasterMode uint

GPU_NAMESPACE_BEGIN

const uint kChunkTriangles = 64u;    // triangles of one draw that one workgroup takes
const uint kSingleTriangles = 24u;   // a draw of fewer shares workgroups with others
const uint kResolveGroup = 64u;      // threads of a workgroup where one thread takes one voxel
const uint kRowsGroup = 64u;         // threads of a workgroup of voxelize/rows
const uint kBandsGroup = 32u;        // threads of a workgroup of voxelize/bands
const uint kBandStrips = 64u;        // strips of kBlockRows rows in a band: bounds a thread's work
const uint kBlockRows = 8u;          // rows of a row block: one thread each
const uint kSmallColumns = 32u;      // a triangle over more columns is rasterized by rows; one bit of a mask each
const int kSmallExtent = 8192;       // lattice units: a triangle up to this size is rasterized in 32-bit integers
const int kTileExtent = 1 << 26;     // lattice units: the tiles of a triangle up to this size are 4x4 columns
const uint kRowBlocksMax = 1u << 28; // row blocks that one run may list
const uint kGroupsXMax = 65535u;     // workgroups along x that every device allows
const uint kFragmentsMax = 65535u;   // fragments of a voxel that 32-bit sums hold

const int kLatticeLimit = 1 << 29; // vertices beyond are dropped
const int kVoxelLattice = 256;     // lattice units a voxel
const int kVoxelLatticeLog2 = 8;

// Specialization constant coverage: which voxels a triangle covers.
const uint kCoverageConservative = 0u;
const uint kCoverageThin = 1u;

// Specialization constant mode: what is done with a fragment.
const uint kModeCoverage = 0u;   // sets the voxel's bit
const uint kModeAttributes = 1u; // adds its colour and normal to the voxel's sums
const uint kModeEmission = 2u;   // adds its emission to the emissive voxel's sums

// Specialization constant material_class: what the materials of the draws need.
const uint kClassPlain = 0u;    // no textures, opaque
const uint kClassTextured = 1u; // opaque
const uint kClassAlpha = 2u;    // alpha decides which fragments exist
const uint kClassCount = 3u;

/// Sums over the fragments of a voxel, values shifted right by sum_shift. 32 bytes: one sector of memory, and four
/// pairs of words that are 64-bit numbers to 64-bit atomics. No sum of fewer than
/// (kFragmentsMax + 1) << sum_shift values carries.
struct VoxelSums
{
    uint red; // linear, 16-bit fractions
    uint green;
    uint blue;
    uint normal_x; // length 32767; shifted, each value has normalBias() added, so that none is negative
    uint normal_y;
    uint normal_z;
    uint fragments;
    uint zero; // always 0: the upper half of the 64-bit number whose lower half is fragments
};
GPU_BUFFER(VoxelSums, 8);

const uint kVoxelSumsBytes = 32u;

/// What is added to each component of a fragment's normal that was shifted right by sum_shift.
GPU_FUNCTION uint normalBias(uint sum_shift)
{
    return sum_shift < 16u ? 32768u >> sum_shift : 1u;
}

/// Sums of the emission of an emissive voxel: 16-bit fractions of the scene's brightest emission.
struct EmissionSums
{
    uint red;
    uint green;
    uint blue;
};
GPU_BUFFER(EmissionSums, 4);

/// Triangles [first_triangle, first_triangle + kChunkTriangles) of a draw; of a draw that shares workgroups, the first
/// of these alone.
struct Chunk
{
    uint draw;
    uint first_triangle;
};
GPU_BUFFER(Chunk, 4);

/// A band of kBandStrips * kBlockRows rows of a triangle that is rasterized by rows, already on the lattice.
struct BigTriangle
{
    ivec3 v0;
    ivec3 v1;
    ivec3 v2;
    uint draw;
    uint triangle;
    uint band; // counted from the first row of the triangle inside the grid
};
GPU_BUFFER(BigTriangle, 4);

/// kBlockRows rows by block_columns columns of a big triangle.
struct RowBlock
{
    uint band;     // in the list of big triangles
    uint position; // row / kBlockRows | column / block_columns << 16, counted from the triangle's first inside the grid
};
GPU_BUFFER(RowBlock, 4);

/// Counts of one run over the triangles of one material class, and the dispatches that follow from them. Counting goes
/// on past a capacity.
struct RasterCounters
{
    uint big_count;       // bands
    uint block_count;     // of the bands that found room
    uint blocks_exceeded; // more than kRowBlocksMax: a count may have wrapped around
    uint overflow_count;  // leaves that found no slot in the brick table
    uint nonfinite;
    uint out_of_range;
    uint outside;
    uint zero_area;
    uint arrived;       // threads of the running dispatch (lib/arrivals.glsl); 0 in between
    DispatchArgs bands; // of voxelize/bands
    DispatchArgs rows;  // of voxelize/rows
};
GPU_BUFFER(RasterCounters, 4);

// Of every kernel with voxelize/constants.glsl.
#define RASTER_CONSTANTS(CONSTANT)                                                                                     \
    CONSTANT(0, Coverage, coverage, kCoverage, kCoverageConservative)                                                  \
    CONSTANT(1, RasterMode, mode, kMode, kModeCoverage)                                                                \
    CONSTANT(2, MaterialClass, material_class, kMaterialClass, kClassPlain)                                            \
    CONSTANT(3, bool, emits, kEmits, false)                                                                            \
    CONSTANT(4, uint, block_columns, kBlockColumns, 256u) /* of a row block: bounds the work of a thread */            \
    CONSTANT(5, uint, strip_lanes, kStripLanes, 1u)       /* threads of voxelize/bands that share a band */

struct RasterParams // push constants of voxelize/triangles and voxelize/rows
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(Chunk) chunks;        // [chunk_count]
    GPU_PTR(BrickEntry) bricks;         // [brick_mask + 1], and as many MixedVoxels where these are told apart
    GPU_PTR(BigTriangle) big_triangles; // [big_capacity]
    GPU_PTR(RowBlock) row_blocks;       // [block_capacity]
    GPU_PTR(RasterCounters) counters;   // [1]
    GPU_CONST_PTR(Node) nodes;          // not in coverage mode
    GPU_PTR(VoxelSums) sums;            // [voxel_count], or of mixed voxels alone
    GPU_PTR(Attribute) attributes;      // [voxel_count] written for voxels that are not mixed, where these have no sums
    GPU_PTR(uvec2) emission_words;      // [ceil(voxel_count / 32)]
    GPU_PTR(EmissionSums) emission_sums; // [emissive voxels]
    vec3 origin;                         // world position of the grid's minimum corner
    float lattice_scale;                 // lattice units per world unit
    uint window;                         // depth of the grid, and which cube of it is voxelized (voxelize/window.h)
    uint brick_mask;
    uint chunk_count;
    uint big_capacity;
    uint block_capacity;
    uint sum_shift; // bits dropped from values before they are added
};
GPU_KERNEL(voxelize, bands, Bands, RasterParams, RASTER_CONSTANTS)
#define VOXELIZE_ROWS_CONSTANTS(CONSTANT)                                                                              \
    RASTER_CONSTANTS(CONSTANT)                                                                                         \
    CONSTANT(6, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(7, bool, mixed, kMixed, false)
GPU_KERNEL(voxelize, rows, Rows, RasterParams, VOXELIZE_ROWS_CONSTANTS)
GPU_KERNEL(voxelize, rows_int64, RowsInt64, RasterParams, VOXELIZE_ROWS_CONSTANTS)
#define VOXELIZE_TRIANGLES_CONSTANTS(CONSTANT)                                                                         \
    RASTER_CONSTANTS(CONSTANT)                                                                                         \
    CONSTANT(6, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(7, bool, mixed, kMixed, false)                                                                            \
    CONSTANT(8, bool, single, kSingle, false) /* a chunk is one triangle, and a thread takes it */
GPU_KERNEL(voxelize, triangles, Triangles, RasterParams, VOXELIZE_TRIANGLES_CONSTANTS)
GPU_KERNEL(voxelize, triangles_int64, TrianglesInt64, RasterParams, VOXELIZE_TRIANGLES_CONSTANTS)

struct ResolveParams // push constants of voxelize/resolve
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(VoxelSums) sums;       // [voxel_count]
    GPU_CONST_PTR(uvec2) emission_words; // [ceil(voxel_count / 32)], or null without emission
    GPU_PTR(Attribute) attributes;       // [voxel_count]
    GPU_PTR(uint) max_fragments;         // [1] raised to the largest fragment count of a voxel
    uint voxel_count;
    uint has_emission;
    uint sum_shift;
};
GPU_KERNEL(voxelize, resolve, Resolve, ResolveParams, GPU_NO_CONSTANTS)

struct ResolveMixedParams // push constants of voxelize/resolve_mixed: kLanes threads a leaf
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(BrickEntry) bricks; // [brick_mask + 1], and as many MixedVoxels
    GPU_CONST_PTR(WorkItem) items;    // [leaf_count]
    GPU_CONST_PTR(Node) nodes;        // with wide keys, which are not in the table any more
    GPU_CONST_PTR(VoxelSums) sums;    // [mixed voxels]
    GPU_PTR(Attribute) attributes;    // [voxel_count]
    GPU_PTR(uint) max_fragments;      // [1] raised to the largest fragment count of a voxel
    uint brick_mask;
    uint leaf_count;
    uint sum_shift;
};
#define VOXELIZE_RESOLVE_MIXED_CONSTANTS(CONSTANT)                                                                     \
    CONSTANT(0, bool, wide_keys, kWideKeys, false) /* the octree has more than kNarrowLevelsMax levels */              \
    CONSTANT(1, uint, lanes, kLanes, 1u)           /* threads that share a leaf, a power of two up to 16 */
GPU_KERNEL(voxelize, resolve_mixed, ResolveMixed, ResolveMixedParams, VOXELIZE_RESOLVE_MIXED_CONSTANTS)

struct EmissionRankParams // push constants of voxelize/emission_count and voxelize/emission_rank
{
    GPU_PTR(uvec2) words;   // [word_count] bits, rank
    GPU_PTR(uint) partials; // [ceil(word_count / kScanBlock)]
    uint word_count;
};
GPU_KERNEL(voxelize, emission_count, EmissionCount, EmissionRankParams, GPU_NO_CONSTANTS)
GPU_KERNEL(voxelize, emission_rank, EmissionRank, EmissionRankParams, GPU_NO_CONSTANTS)

struct ResolveEmissionParams // push constants of voxelize/resolve_emission
{
    GPU_CONST_PTR(VoxelSums) sums;             // [voxel_count]
    GPU_CONST_PTR(EmissionSums) emission_sums; // [emissive voxels]
    GPU_CONST_PTR(uvec2) emission_words;       // [ceil(voxel_count / 32)]
    GPU_PTR(uint) emission;                    // [emissive voxels] as RGB9E5
    uint voxel_count;
    uint sum_shift;
};
GPU_KERNEL(voxelize, resolve_emission, ResolveEmission, ResolveEmissionParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
