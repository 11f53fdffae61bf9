// SPDX-License-Identifier: MIT
// What the kernels that trace rays share with the host. For where rays begin, see beam.h and node_paths.h; for the
// light at hits, light.h.
#ifndef ZVO_SHADERS_TRACE_TRACE_H
#define ZVO_SHADERS_TRACE_TRACE_H

#include "shared/attribute_formats.h"
#include "shared/svdag.h"
#include "shared/trace.h"

GPU_ENUM(AttributeFormat, std::uint32_t) // kFormat8 and so on (shared/attribute_formats.h)

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
#define TRAVERSE_CONSTANTS                                                                                             \
    GPU_CONSTANT(uint, node_levels, 5u)                                                                                \
    GPU_CONSTANT(bool, detail, false)                                                                                  \
    GPU_CONSTANT(uint, iterations_max, kTraceIterationsMax)                                                            \
    GPU_CONSTANT(uint, entries_per_word, 0u)

// Of every kernel with trace/traverse_paths.glsl.
#define PATHS_CONSTANTS                                                                                                \
    GPU_CONSTANT(bool, paths, false)                                                                                   \
    GPU_CONSTANT(bool, paths_relative, false)

// Of every kernel with trace/primary.glsl, behind TRAVERSE_CONSTANTS.
#define PRIMARY_CONSTANTS                                                                                              \
    GPU_CONSTANT(bool, orthographic, false)                                                                            \
    GPU_CONSTANT(bool, count_iterations, false)                                                                        \
    PATHS_CONSTANTS                                                                                                    \
    GPU_CONSTANT(bool, overlays, false)                                                                                \
    GPU_CONSTANT(bool, resume, false)                                                                                  \
    GPU_CONSTANT(bool, more, false)

struct RaysParams // push constants of trace/rays
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Ray) rays; // [ray_count]
    GPU_PTR(Hit) hits;       // [ray_count]
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) next_round; // [1] cleared; kMore only
    GPU_CONST_PTR(uint) list_length;  // [1], at most ray_count; kCounted only
    vec2 detail;                      // as traverse()
    uint ray_count;
};
GPU_KERNEL_BEGIN(trace, rays, Rays, RaysParams)
    TRAVERSE_CONSTANTS
    GPU_CONSTANT(bool, resume, false)
    GPU_CONSTANT(bool, more, false)
    GPU_CONSTANT(bool, counted, false)
GPU_KERNEL_END

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
GPU_KERNEL_BEGIN(trace, ranks, Ranks, RanksParams)
    GPU_CONSTANT(uint, node_levels, 5u)
    GPU_CONSTANT(bool, detail, false)
    GPU_CONSTANT(bool, tiles, true)
    GPU_CONSTANT(uint, entries_per_word, 2u)
    GPU_CONSTANT(bool, overlays, false)
    GPU_CONSTANT(bool, counted, false)
GPU_KERNEL_END

struct PrimaryParams // push constants of trace/primary
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint64_t) paths; // of trace/node_paths; kPaths only
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
GPU_KERNEL_BEGIN(trace, primary, Primary, PrimaryParams)
    TRAVERSE_CONSTANTS
    PRIMARY_CONSTANTS
GPU_KERNEL_END

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
GPU_KERNEL_BEGIN(trace, primary_ranks, PrimaryRanks, PrimaryRanksParams)
    TRAVERSE_CONSTANTS
    PRIMARY_CONSTANTS
GPU_KERNEL_END

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
GPU_KERNEL_BEGIN(trace, depth, Depth, DepthParams)
    GPU_CONSTANT(bool, orthographic, false)
GPU_KERNEL_END

/// What the ray of one pixel meets.
struct PixelReport
{
    uint hit;        // 1: something; 0: nothing, and all but iterations is undefined
    float t;         // as in Hit
    uvec3 cell;      // coordinates at its level
    uint level;      // of nodes; nodeLevels() for a voxel
    uint face;       // as in Hit
    uint node;       // that the cell is in: its number among the nodes
    uint index;      // of its attributes, as in Hit
    Attribute look;  // base colour and normal, in 8 bytes whatever their format; 0 without attributes
    uint iterations; // of the traversal's loop, from the camera on
};
GPU_BUFFER(PixelReport, 4);

struct InspectParams // push constants of trace/inspect: kArgsGroup threads, of which one works
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(Attribute) attributes; // of voxels, in the format of kFormat
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_PTR(PixelReport) report; // [1]
    CameraRays camera;
    uint width;
    uint height;
    uint pixel; // row by row
    vec2 detail;
};
GPU_KERNEL_BEGIN(trace, inspect, Inspect, InspectParams)
    TRAVERSE_CONSTANTS
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(AttributeFormat, format, kFormat8)
GPU_KERNEL_END

GPU_NAMESPACE_END

#endif
