// SPDX-License-Identifier: MIT
// What the kernels of the thesis share with the host: Y. Pan, Dynamic Update of Sparse Voxel Octree Based on Morton
// Code, Purdue University, 2021. Every kernel visits all 8^level cells of a level, or those between the smallest and
// the largest Morton code that occurs.
#ifndef ZVO_SHADERS_BASELINE_THESIS_H
#define ZVO_SHADERS_BASELINE_THESIS_H

#include "baseline/pointer_octree.h"
#include "shared/octree.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "voxelize/voxelize.h"

GPU_NAMESPACE_BEGIN

const uint kThesisGroup = 64u;       // threads of a workgroup where one thread takes a triangle or a cell
const uint kThesisLevelGroup = 128u; // threads where one takes the eight cells below a cell
const uint kThesisParts = 64u;       // parts of a box that are tested in one dispatch after the first
const uint kThesisTileEdge = 8u;     // pixels of a workgroup's square in a picture
const uint kThesisDepthMax = 10u;    // 8^10 dense cells; Morton codes of 30 bits
const uint kThesisLevels = 11u;      // levels of cells at that depth

// Specialization constant target: what becomes of a covered voxel.
const uint kThesisOccupancy = 0u; // its cell is marked
const uint kThesisColors = 1u;    // its cell gets the fragment's colour and normal: the last writer wins
const uint kThesisSums = 2u;      // the fragment is added to the cell's sums, as zvo does
const uint kThesisFragments = 3u; // the fragment is appended to a list

/// What baseline/thesis_setup computes of a triangle: the members of a RasterTriangle (voxelize/raster.glsl). 96 bytes.
struct ThesisTriangle
{
    ivec3 u; // lattice coordinates of the corners, permuted and mirrored
    ivec3 v;
    ivec3 w;
    ivec2 rise_u; // 64-bit numbers, lower half first
    ivec2 rise_v;
    ivec2 n_w;
    ivec3 low; // voxels that the bounding box touches, inside the grid; low > high for a triangle that covers none
    ivec3 high;
    uint bits; // axis 2 | u mirrored 1 | v mirrored 1 | exchanged 1 | normal's u, v, w negative 3
    uint draw;
    uint triangle; // of the draw
};
GPU_BUFFER(ThesisTriangle, 4);

const uint kThesisMirrorShift = 2u; // in ThesisTriangle::bits
const uint kThesisExchangedShift = 4u;
const uint kThesisSignShift = 5u;

/// What the voxelization counts.
struct ThesisCounters
{
    uint part_count;     // parts of the largest bounding box: 1 where threads take whole boxes
    uint big_count;      // triangles whose boxes have more than one part
    uint fragment_count; // appended, or not for want of room
    uint code_min;       // smallest and largest Morton code of a covered voxel
    uint code_max;
};
GPU_BUFFER(ThesisCounters, 4);

/// The columns of a part of a bounding box, each of `layers` cells.
GPU_FUNCTION uint thesisColumns(uint cells_per_part, uint layers)
{
    uint columns = cells_per_part / layers;
    return columns == 0u ? 1u : columns;
}

struct ThesisSetupParams // push constants of baseline/thesis_setup
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(Chunk) chunks;       // [chunk_count]
    GPU_PTR(ThesisTriangle) triangles; // [triangles of all classes]
    GPU_PTR(uint) big;                 // [triangles of all classes] those whose boxes have more than one part
    GPU_PTR(ThesisCounters) counters;
    vec3 origin; // as in BinParams, like the next two
    float lattice_scale;
    uint window;
    uint chunk_count;
    uint chunk_triangles; // of a chunk at most: kChunkTriangles or 1
    uint first_triangle;  // where those of the first chunk go
    uint cells_per_part;  // as in ThesisVoxelizeParams
};
#define BASELINE_THESIS_SETUP_CONSTANTS(CONSTANT) CONSTANT(0, Coverage, coverage, kCoverage, kCoverageConservative)
GPU_KERNEL(baseline, thesis_setup, ThesisSetup, ThesisSetupParams, BASELINE_THESIS_SETUP_CONSTANTS)

struct ThesisVoxelizeParams // push constants of baseline/thesis_voxelize
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(ThesisTriangle) triangles; // [triangles of all classes]
    GPU_CONST_PTR(uint) big;                 // [big_count] numbers of triangles; after the first dispatch
    GPU_PTR(ThesisCounters) counters;
    GPU_PTR(Attribute) cells;         // [8^depth] by Morton code
    GPU_PTR(VoxelSums) sums;          // [8^depth] kThesisSums only
    GPU_PTR(VoxelFragment) fragments; // [fragment_capacity] kThesisFragments only
    vec3 origin;
    float lattice_scale;
    uint window;
    uint first_triangle; // of the class
    uint triangle_count; // of the class
    uint big_count;      // triangles that are taken from the list; 0: the first dispatch, over all of the class
    uint first_part;     // of each box in this dispatch
    uint cells_per_part; // cells of a bounding box that a thread tests, in whole columns
    uint fragment_capacity;
    uint sum_shift; // 0
};
#define BASELINE_THESIS_VOXELIZE_CONSTANTS(CONSTANT)                                                                   \
    CONSTANT(0, Coverage, coverage, kCoverage, kCoverageConservative)                                                  \
    CONSTANT(1, MaterialClass, material_class, kMaterialClass, kClassPlain)                                            \
    CONSTANT(2, uint, target, kTarget, 0u)                                                                             \
    CONSTANT(3, bool, bounds, kBounds, false) /* find the smallest and the largest Morton code */
GPU_KERNEL(baseline, thesis_voxelize, ThesisVoxelize, ThesisVoxelizeParams, BASELINE_THESIS_VOXELIZE_CONSTANTS)

struct ThesisResolveParams // push constants of baseline/thesis_resolve
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(VoxelSums) sums; // [8^depth]
    GPU_PTR(Attribute) cells;      // [8^depth]
    uint first_cell;
    uint cell_count;
};
GPU_KERNEL(baseline, thesis_resolve, ThesisResolve, ThesisResolveParams, GPU_NO_CONSTANTS)

struct ThesisCountParams // push constants of baseline/thesis_count
{
    GPU_CONST_PTR(Attribute) voxels;     // as in ThesisLevelParams
    GPU_CONST_PTR(PointerNode) children; // as in ThesisLevelParams
    GPU_PTR(uint) partials;              // [ceil(cell_count / kThesisLevelGroup)] cells with something below them
    uint first_cell;
    uint cell_count;
    uint first_child;
    uint child_count;
};
#define BASELINE_THESIS_COUNT_CONSTANTS(CONSTANT) CONSTANT(0, bool, voxels, kVoxels, false)
GPU_KERNEL(baseline, thesis_count, ThesisCount, ThesisCountParams, BASELINE_THESIS_COUNT_CONSTANTS)

struct ThesisLevelParams // push constants of baseline/thesis_level
{
    GPU_CONST_PTR(Attribute) voxels;     // [8^depth] where these are the children
    GPU_CONST_PTR(PointerNode) children; // [8^(level + 1)] otherwise
    GPU_PTR(PointerNode) parents;        // [8^level]
    GPU_PTR(PointerNode) nodes;          // [node_capacity]
    GPU_CONST_PTR(uint) partials;        // [ceil(cell_count / kThesisLevelGroup)] scanned; without kAtomic
    GPU_PTR(uint) tiles;                 // [kThesisLevels] tiles below the cells of each level
    uint level;                          // of the cells: a thread each
    uint depth;
    uint first_cell; // of the cells that have a thread
    uint cell_count;
    uint first_child; // of the children that may be occupied
    uint child_count;
    uint root; // number of the octree's root; its tiles stand behind it
    uint node_capacity;
    uint static_root; // of the octree that is merged; kMerge only
};
#define BASELINE_THESIS_LEVEL_CONSTANTS(CONSTANT)                                                                      \
    CONSTANT(0, bool, voxels, kVoxels, false)                                                                          \
    CONSTANT(1, bool, atomic, kAtomic, false) /* tiles are numbered by an atomic counter */                            \
    CONSTANT(2, bool, merge, kMerge, false)
GPU_KERNEL(baseline, thesis_level, ThesisLevel, ThesisLevelParams, BASELINE_THESIS_LEVEL_CONSTANTS)

struct ThesisTraceParams // push constants of baseline/thesis_trace
{
    GPU_CONST_PTR(PointerNode) nodes;
    GPU_PTR(Hit) hits;           // [width * height] row by row
    GPU_PTR(TraceStatus) status; // [1] capped_rays is added to
    CameraRays camera;
    uint width;
    uint height;
    uint root;
    uint depth;
};
#define BASELINE_THESIS_TRACE_CONSTANTS(CONSTANT) CONSTANT(0, bool, orthographic, kOrthographic, false)
GPU_KERNEL(baseline, thesis_trace, ThesisTrace, ThesisTraceParams, BASELINE_THESIS_TRACE_CONSTANTS)

GPU_NAMESPACE_END

#endif
