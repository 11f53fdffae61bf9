// SPDX-License-Identifier: MIT
// What the kernels of the slides' algorithms share with the host (src/baseline/slides_builder.h, slides_trace.h).
//
// A node has 8 children, in Morton order. It takes 9 words, or 17 with prefix sums:
//
//     byte 0      4            36                 68
//          | mask | children 8 | voxels before 8 |
//
//   mask: 8 bits, the children that exist
//   children: their numbers; kSlidesNoNode for those that do not exist, and for voxels
//   voxels before: how many voxels of the node come before each child
//
// Nodes stand by levels, from the parents of voxels to the root, which is the last node; within a level in Morton
// order, those of a DAG by the first place in that order at which they occur.
#ifndef ZVO_SHADERS_BASELINE_SLIDES_H
#define ZVO_SHADERS_BASELINE_SLIDES_H

#include "shared/octree.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "voxelize/voxelize.h"

GPU_NAMESPACE_BEGIN

const uint kSlidesDepthMax = 13u;
const uint kSlidesLevels = 14u; // of nodes and voxels: kSlidesDepthMax + 1

const uint kSlidesNodeWords = 9u;
const uint kSlidesSumNodeWords = 17u; // with prefix sums
const uint kSlidesNoNode = ~0u;

const uint kSlidesGroup = 64u;  // threads of a workgroup
const uint kSlidesItems = 8u;   // consecutive elements that a thread takes where their sums are scanned
const uint kSlidesBlock = 512u; // elements that a workgroup takes there: kSlidesGroup * kSlidesItems

const uint kSlidesTooMany = ~0u; // a total that does not fit 32 bits

// A loop of an invocation ends silently after 65,535 iterations on lavapipe, all loops counted. So a triangle is
// divided into pieces, a thread each: rectangles of rows and columns. The threads of a subgroup go through their rows
// together, each row as long as the longest: row r of pieces with several rows has at most kSlidesPieceColumns / r
// columns, all rows of any number of threads less than 7 kSlidesPieceColumns, and a column at most four layers.
const uint kSlidesPieceColumns = 512u;     // of all rows of a piece, unless one row has more
const uint kSlidesPieceWidth = 4096u;      // columns of a row
const uint kSlidesVoxelFragments = 50000u; // fragments of a voxel that are averaged

const int kSlidesLatticeLimit = 1 << 24; // triangles with vertices beyond are dropped

const uint kSlidesProbesMax = 256u; // slots that an insert looks at before the table counts as full
const uint kSlidesFreeSlot = ~0u;

const uint kSlidesStatesMax = 14u;        // states of nodes that a ray keeps
const uint kSlidesChildrenMax = 40u;      // or children of nodes: 3 a level, and the root's
const uint kSlidesIterationsMax = 40000u; // of a ray

/// What the passes count for the host.
struct SlidesCounters
{
    uint nonfinite; // dropped triangles, by the reasons of docs/voxelization.md
    uint out_of_range;
    uint outside;
    uint zero_area;
    uint piece_count;
    uint fragment_count;
    uint voxel_count;
    uint leaders[kSlidesLevels];     // [i] voxels whose ancestor i levels above is the last one that they come first in
    uint node_counts[kSlidesLevels]; // nodes of each level, the parents of voxels first
    uint overflow_count;             // nodes that found no slot
    uint capped_voxels;              // voxels with more than kSlidesVoxelFragments fragments
};
GPU_BUFFER(SlidesCounters, 4);

/// A rectangle of a triangle's columns.
struct SlidesPiece
{
    uint draw;
    uint triangle;
    uint number; // among the triangle's pieces
};
GPU_BUFFER(SlidesPiece, 4);

/// The attributes of a fragment: six 16-bit numbers, those of the normal with normalBias(0) added.
struct SlidesFragment
{
    uint red_green; // linear
    uint blue_x;
    uint y_z;
};
GPU_BUFFER(SlidesFragment, 4);

struct SlidesScanParams // push constants of baseline/slides_scan_sums and baseline/slides_scan_apply
{
    GPU_PTR(uint) values;   // [count]
    GPU_PTR(uint) partials; // [ceil(count / kSlidesBlock)] sums of blocks; to be scanned in between
    uint count;
};
GPU_KERNEL(baseline, slides_scan_sums, SlidesScanSums, SlidesScanParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, slides_scan_apply, SlidesScanApply, SlidesScanParams, GPU_NO_CONSTANTS)

struct SlidesScanTopParams // push constants of baseline/slides_scan_top: one workgroup
{
    GPU_PTR(uint) values; // [count]
    GPU_PTR(uint) total;  // [1] gets the sum of all values, or kSlidesTooMany
    uint count;
};
GPU_KERNEL(baseline, slides_scan_top, SlidesScanTop, SlidesScanTopParams, GPU_NO_CONSTANTS)

struct SlidesPiecesParams // push constants of baseline/slides_pieces
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(Chunk) chunks;      // [chunk_count]
    GPU_PTR(uint) piece_counts;       // [slots] of each triangle; scanned with kList
    GPU_PTR(SlidesPiece) pieces;      // [all pieces]; kList only
    GPU_PTR(SlidesCounters) counters; // [1]; not with kList
    vec3 origin;                      // world position of the grid's minimum corner
    float lattice_scale;              // lattice units per world unit
    uint depth;                       // of the grid
    uint chunk_count;
    uint first_slot;
};
#define BASELINE_SLIDES_PIECES_CONSTANTS(CONSTANT)                                                                     \
    CONSTANT(0, Coverage, coverage, kCoverage, kCoverageConservative)                                                  \
    CONSTANT(1, bool, list, kList, false)                                                                              \
    CONSTANT(2, bool, single, kSingle, false) /* a chunk is one triangle, and a thread takes it */
GPU_KERNEL(baseline, slides_pieces, SlidesPieces, SlidesPiecesParams, BASELINE_SLIDES_PIECES_CONSTANTS)

struct SlidesFragmentsParams // push constants of baseline/slides_fragments
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(SlidesPiece) pieces; // [piece_count]
    GPU_PTR(uint) fragment_counts;     // [piece_count]; scanned with kEmit
    GPU_PTR(uint64_t) keys;            // [fragment_count] Morton codes; kEmit only
    GPU_PTR(SlidesFragment) fragments; // [fragment_count]; kEmit and kAttributes only
    vec3 origin;                       // as in SlidesPiecesParams
    float lattice_scale;
    uint depth;
    uint piece_count;
};
#define BASELINE_SLIDES_FRAGMENTS_CONSTANTS(CONSTANT)                                                                  \
    CONSTANT(0, Coverage, coverage, kCoverage, kCoverageConservative)                                                  \
    CONSTANT(1, MaterialClass, material_class, kMaterialClass, kClassPlain)                                            \
    CONSTANT(2, bool, attributes, kAttributes, false)                                                                  \
    CONSTANT(3, bool, emit, kEmit, false)
GPU_KERNEL(baseline, slides_fragments, SlidesFragments, SlidesFragmentsParams, BASELINE_SLIDES_FRAGMENTS_CONSTANTS)

struct SlidesUniqueParams // push constants of baseline/slides_unique_count and baseline/slides_unique
{
    GPU_CONST_PTR(uint64_t) keys;     // [key_count] sorted
    GPU_PTR(uint) partials;           // [ceil(key_count / kSlidesBlock)] different keys; scanned for slides_unique
    GPU_PTR(SlidesCounters) counters; // [1]; slides_unique_count only
    GPU_PTR(uint64_t) codes;          // [voxels]; slides_unique only, as the next one
    GPU_PTR(uint) firsts;             // [voxels] the first key of each voxel
    uint key_count;
    uint depth;
};
GPU_KERNEL(baseline, slides_unique_count, SlidesUniqueCount, SlidesUniqueParams, GPU_NO_CONSTANTS)
GPU_KERNEL(baseline, slides_unique, SlidesUnique, SlidesUniqueParams, GPU_NO_CONSTANTS)

struct SlidesAverageParams // push constants of baseline/slides_average
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(uint) firsts;              // [voxel_count]
    GPU_CONST_PTR(uint) indices;             // [fragment_count] fragments in the order of their keys
    GPU_CONST_PTR(SlidesFragment) fragments; // [fragment_count]
    GPU_PTR(Attribute) attributes;           // [voxel_count]
    GPU_PTR(SlidesCounters) counters;        // [1]
    uint voxel_count;
    uint fragment_count;
};
GPU_KERNEL(baseline, slides_average, SlidesAverage, SlidesAverageParams, GPU_NO_CONSTANTS)

/// The cells of a level that become the children of nodes of the level above, in Morton order.
struct SlidesParentsParams // push constants of baseline/slides_parents_count and baseline/slides_parents
{
    GPU_CONST_PTR(uint64_t) codes;  // [cell_count]
    GPU_CONST_PTR(uint) children;   // [cell_count] their nodes; not with kLeaves, as the next one
    GPU_CONST_PTR(uint) voxels;     // [cell_count] below each
    GPU_PTR(uint) partials;         // [ceil(cell_count / kSlidesBlock)] parents; scanned for slides_parents
    GPU_PTR(uint64_t) parent_codes; // [parents]
    GPU_PTR(uint) parent_nodes;     // [parents] not of a DAG, for which slides_class_children writes them
    GPU_PTR(uint) parent_voxels;    // [parents]
    GPU_PTR(uint) nodes;            // [parents] nodes
    uint cell_count;
    uint first_node; // number of the first parent
};
GPU_KERNEL(baseline, slides_parents_count, SlidesParentsCount, SlidesParentsParams, GPU_NO_CONSTANTS)
#define BASELINE_SLIDES_PARENTS_CONSTANTS(CONSTANT)                                                                    \
    CONSTANT(0, uint, node_words, kNodeWords, kSlidesSumNodeWords)                                                     \
    CONSTANT(1, bool, leaves, kLeaves, false) /* the cells are voxels */                                               \
    CONSTANT(2, bool, dag, kDag, false)
GPU_KERNEL(baseline, slides_parents, SlidesParents, SlidesParentsParams, BASELINE_SLIDES_PARENTS_CONSTANTS)

/// The nodes of a level of which equal ones become one. A class of equal nodes is known by its slot in a hash table,
/// which in the end holds the number of its first candidate.
struct SlidesClassParams // push constants of baseline/slides_class_*
{
    GPU_CONST_PTR(uint) candidates;   // [candidate_count] nodes
    GPU_PTR(uint) table;              // [slot_mask + 1], all kSlidesFreeSlot in the beginning
    GPU_PTR(uint) slots;              // [candidate_count] of the candidates' classes
    GPU_PTR(uint) partials;           // [ceil(candidate_count / kSlidesBlock)] classes; scanned for slides_class_nodes
    GPU_PTR(uint) numbers;            // [candidate_count] the nodes that the classes' first candidates became
    GPU_PTR(uint) nodes;              // the DAG's
    GPU_PTR(uint) parent_nodes;       // [candidate_count] the nodes that all candidates became
    GPU_PTR(SlidesCounters) counters; // [1]
    uint candidate_count;
    uint slot_mask;
    uint level; // of the nodes, from the voxels' parents on
};
#define BASELINE_SLIDES_CLASS_INSERT_CONSTANTS(CONSTANT) CONSTANT(0, uint, node_words, kNodeWords, kSlidesSumNodeWords)
GPU_KERNEL(baseline, slides_class_insert, SlidesClassInsert, SlidesClassParams, BASELINE_SLIDES_CLASS_INSERT_CONSTANTS)
GPU_KERNEL(baseline, slides_class_count, SlidesClassCount, SlidesClassParams, GPU_NO_CONSTANTS)
#define BASELINE_SLIDES_CLASS_NODES_CONSTANTS(CONSTANT) CONSTANT(0, uint, node_words, kNodeWords, kSlidesSumNodeWords)
GPU_KERNEL(baseline, slides_class_nodes, SlidesClassNodes, SlidesClassParams, BASELINE_SLIDES_CLASS_NODES_CONSTANTS)
GPU_KERNEL(baseline, slides_class_children, SlidesClassChildren, SlidesClassParams, GPU_NO_CONSTANTS)

/// Counts of a trace for the host.
struct SlidesTraceStatus
{
    uint capped_rays; // that used up their iterations, and count as misses
};
GPU_BUFFER(SlidesTraceStatus, 4);

struct SlidesTraceParams // push constants of baseline/slides_trace: a workgroup for each tile of 8x8 pixels
{
    GPU_CONST_PTR(uint) nodes;
    GPU_PTR(Hit) hits; // [width * height] row by row
    GPU_PTR(SlidesTraceStatus) status;
    CameraRays camera;
    uint width;
    uint height;
    uint root;
    uint depth; // of the grid
};
#define BASELINE_SLIDES_TRACE_CONSTANTS(CONSTANT)                                                                      \
    CONSTANT(0, uint, node_words, kNodeWords, kSlidesSumNodeWords)                                                     \
    CONSTANT(1, bool, push_children, kPushChildren, false)                                                             \
    CONSTANT(2, bool, stop_at_far_side, kStopAtFarSide, true)                                                          \
    CONSTANT(3, bool, skip_behind, kSkipBehind, true)                                                                  \
    CONSTANT(4, bool, orthographic, kOrthographic, false)
GPU_KERNEL(baseline, slides_trace, SlidesTrace, SlidesTraceParams, BASELINE_SLIDES_TRACE_CONSTANTS)

GPU_NAMESPACE_END

#endif
