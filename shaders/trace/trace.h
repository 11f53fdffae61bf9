// SPDX-License-Identifier: MIT
// What the kernels that trace rays share with the host. For where rays begin, see beam.h and node_paths.h; for the
// light at hits, light.h.
#ifndef ZVO_SHADERS_TRACE_TRACE_H
#define ZVO_SHADERS_TRACE_TRACE_H

#include "shared/attribute_formats.h"
#include "shared/svdag.h"
#include "shared/trace.h"

GPU_ENUM(AttributeFormat) // kFormat8 and so on (shared/attribute_formats.h)
#define GPU_TYPE_AttributeFormat uint

GPU_NAMESPACE_BEGIN

const uint kRaysGroup = 64u; // threads of a workgroup of trace/rays

// Pictures are traced in square tiles, one workgroup each.
const uint kTileEdge = 8u;             // pixels
const uint kTilePixels = 64u;          // and threads of the workgroup
const uint kBlockEdge = 8u;            // tiles: a workgroup of trace/beam takes a square block of them
const uint kBlockTiles = 64u;          // and threads of the workgroup
const uint kTilesFold = 32768u;        // workgroups along x of an indirect dispatch
const uint kNoTile = ~0u;              // in the list of live tiles, after the last one
const float kTileDead = kTraceTimeMax; // a tile's start where no ray of the tile can hit anything

// The constants of every kernel with lib/traverse.glsl.
#define TRAVERSE_CONSTANTS(CONSTANT)                                                                                   \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, bool, detail, kDetail, false)                                                                          \
    CONSTANT(2, uint, iterations_max, kIterationsMax, kTraceIterationsMax)                                             \
    CONSTANT(3, uint, entries_per_word, kEntriesPerWord, 0u)

// Of every kernel with trace/traverse_paths.glsl.
#define PATHS_CONSTANTS(CONSTANT, FIRST)                                                                               \
    CONSTANT(FIRST + 0, bool, paths, kPaths, false)                  /* begin below the root */                        \
    CONSTANT(FIRST + 1, bool, paths_relative, kPathsRelative, false) /* the octree does not stand by levels */

// Of every kernel with trace/primary.glsl, behind TRAVERSE_CONSTANTS.
#define PRIMARY_CONSTANTS(CONSTANT)                                                                                    \
    CONSTANT(4, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(5, bool, count_iterations, kCountIterations, false)                                                       \
    PATHS_CONSTANTS(CONSTANT, 6)                                                                                       \
    CONSTANT(8, bool, overlays, kOverlays, false) /* the upper nodes of a DAG may be those of an overlay */            \
    CONSTANT(9, bool, resume, kResume, false)     /* only rays that the round before left unfinished */                \
    CONSTANT(10, bool, more, kMore, false)        /* another round follows */

struct RaysParams // push constants of trace/rays
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) leaf_groups; // of an octree
    GPU_CONST_PTR(Ray) rays;          // [ray_count]
    GPU_PTR(Hit) hits;                // [ray_count]
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) next_round; // [1] cleared; kMore only
    GPU_CONST_PTR(uint) list_length;  // [1], at most ray_count; kCounted only
    vec2 detail;                      // as traverse()
    uint ray_count;
};
#define TRACE_RAYS_CONSTANTS(CONSTANT)                                                                                 \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    CONSTANT(4, bool, resume, kResume, false)   /* only rays that the round before left unfinished */                  \
    CONSTANT(5, bool, more, kMore, false)       /* another round follows */                                            \
    CONSTANT(6, bool, counted, kCounted, false) /* the device knows how many rays there are */
GPU_KERNEL(trace, rays, Rays, RaysParams, TRACE_RAYS_CONSTANTS)

const uint kSectorWords = 4u;   // of 64 bits, in the 32 bytes that GPUs load at least
const uint kRayLoadsMax = 512u; // of a ray that are noted

struct RayLoadsParams // push constants of trace/ray_loads, which takes valid rays
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Ray) rays;  // [ray_count]
    GPU_PTR(uint) iterations; // [ray_count]
    GPU_PTR(uint) sectors;    // [kRayLoadsMax][ray_count] by load: of the tree's 32-byte sectors, the one that it is of
    uint ray_count;
};
#define TRACE_RAY_LOADS_CONSTANTS(CONSTANT) TRAVERSE_CONSTANTS(CONSTANT)
GPU_KERNEL(trace, ray_loads, RayLoads, RayLoadsParams, TRACE_RAY_LOADS_CONSTANTS)

struct RanksParams // push constants of trace/ranks
{
    RankSource source;
    GPU_CONST_PTR(BeforeChild) overlay_ranks; // by nodes of overlays; kOverlays only, like the last one
    GPU_CONST_PTR(uvec2) live;                // kTiles only
    GPU_CONST_PTR(uint) list_length;          // as in RaysParams; kCounted only
    GPU_PTR(Hit) hits;
    uint width; // of the picture; kTiles only, like the next one
    uint height;
    uint hit_count;        // of a list; without kTiles
    uint attribute_offset; // from an overlay's node to the index of its attributes
};
#define TRACE_RANKS_CONSTANTS(CONSTANT)                                                                                \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)          /* at least 2 */                                          \
    CONSTANT(1, bool, detail, kDetail, false)                /* hits may be nodes */                                   \
    CONSTANT(2, bool, tiles, kTiles, true)                   /* of a picture */                                        \
    CONSTANT(3, uint, entries_per_word, kEntriesPerWord, 2u) /* of lists */                                            \
    CONSTANT(4, bool, overlays, kOverlays, false)            /* the upper nodes may be those of an overlay */          \
    CONSTANT(5, bool, counted, kCounted, false)              /* the device knows how many hits the list has */
GPU_KERNEL(trace, ranks, Ranks, RanksParams, TRACE_RANKS_CONSTANTS)

struct PrimaryParams // push constants of trace/primary
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) leaf_groups; // of an octree
    GPU_CONST_PTR(uint64_t) paths;    // of trace/node_paths; kPaths only
    GPU_CONST_PTR(uvec2) live;
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) next_round; // [1] cleared: of the round that unfinished rays wait for; kMore only
    GPU_PTR(Hit) hits;                // [width * height] row by row, undefined in dead tiles
    GPU_PTR(uint) iterations;         // [width * height] row by row; kCountIterations only
    CameraRays camera;
    uint width;
    uint height;
    vec2 detail;
};
#define TRACE_PRIMARY_CONSTANTS(CONSTANT)                                                                              \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    PRIMARY_CONSTANTS(CONSTANT)
GPU_KERNEL(trace, primary, Primary, PrimaryParams, TRACE_PRIMARY_CONSTANTS)

struct PrimaryRanksParams // push constants of trace/primary_ranks
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint64_t) paths; // of trace/node_paths and trace/node_ranks
    GPU_CONST_PTR(uvec2) live;
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) next_round;
    GPU_PTR(Hit) hits;
    GPU_CONST_PTR(BeforeChild) before; // this and the next as in RankSource
    GPU_CONST_PTR(uint) voxels_before_leaf;
    CameraRays camera;
    uint width;
    uint height;
    uint first_short_entry;
};
#define TRACE_PRIMARY_RANKS_CONSTANTS(CONSTANT)                                                                        \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    PRIMARY_CONSTANTS(CONSTANT)
GPU_KERNEL(trace, primary_ranks, PrimaryRanks, PrimaryRanksParams, TRACE_PRIMARY_RANKS_CONSTANTS)

struct DepthParams // push constants of trace/depth
{
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_PTR(float) depth; // [width * height] row by row; misses and dead tiles keep what is there
    // The host's clip z and w along a ray: their values at the camera's origin, and how much they gain per unit of t
    // along forward, per half pixel to the right, and per half pixel down (CameraRays).
    vec4 clip_z;
    vec4 clip_w;
    uint width;
    uint height;
};
#define TRACE_DEPTH_CONSTANTS(CONSTANT) CONSTANT(0, bool, orthographic, kOrthographic, false)
GPU_KERNEL(trace, depth, Depth, DepthParams, TRACE_DEPTH_CONSTANTS)

/// What the ray of one pixel meets.
struct PixelReport
{
    uint hit;        // 1: something; 0: nothing, and all but iterations is undefined
    float t;         // as in Hit
    uvec3 cell;      // coordinates at its level
    uint level;      // of nodes; nodeLevels() for a voxel
    uint face;       // as in Hit
    uint node;       // that the cell is in: its number among the nodes; of a leaf of a DAG, that of its word
    uint index;      // of its attributes, as in Hit
    Attribute look;  // base colour and normal, in 8 bytes whatever their format; 0 without attributes
    uint iterations; // of the traversal's loop, from the camera on
};
GPU_BUFFER(PixelReport, 4);

struct InspectParams // push constants of trace/inspect: one thread a pixel
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) leaf_groups; // of an octree
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(Attribute) attributes; // of voxels, in the format of kFormat
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_CONST_PTR(uint) pixels;   // [count], row by row
    GPU_PTR(PixelReport) reports; // [count]
    CameraRays camera;
    uint width;
    uint height;
    uint count;
    vec2 detail;
};
#define TRACE_INSPECT_CONSTANTS(CONSTANT)                                                                              \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    CONSTANT(4, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(5, AttributeFormat, format, kFormat,                                                                      \
             kFormat8) /* of attributes; kFormatNone where hits have no index of any */
GPU_KERNEL(trace, inspect, Inspect, InspectParams, TRACE_INSPECT_CONSTANTS)

GPU_NAMESPACE_END

#endif
