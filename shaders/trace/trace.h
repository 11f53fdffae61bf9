// SPDX-License-Identifier: MIT
// What the kernels that trace rays share with the host.
#ifndef ZVO_SHADERS_TRACE_TRACE_H
#define ZVO_SHADERS_TRACE_TRACE_H

#include "shared/attribute_formats.h"
#include "shared/svdag.h"
#include "shared/trace.h"

GPU_ENUM(AttributeFormat, std::uint32_t) // kFormat8 and so on (shared/attribute_formats.h)
GPU_ENUM(TexelFormat, std::uint32_t)     // kTexelRgba8 and so on
GPU_ENUM(TraceStack, std::uint32_t)      // kStackRegisters and so on (shared/trace.h)
GPU_ENUM(View, std::uint32_t)            // kViewColor and so on

GPU_NAMESPACE_BEGIN

GPU_BUFFER(float, 4);

const uint kRaysGroup = 64u; // threads of a workgroup of trace/rays
const uint kSkyRows = 8u;    // pixels that a thread of trace/sky takes: one division finds their column
const uint kSkyGroup = 64u;  // threads of a workgroup of trace/sky

// Pictures are traced in square tiles, one workgroup each.
const uint kTileEdge = 8u;             // pixels
const uint kTilePixels = 64u;          // and threads of the workgroup
const uint kBlockEdge = 8u;            // tiles: a workgroup of trace/beam takes a square block of them
const uint kBlockTiles = 64u;          // and threads of the workgroup
const uint kTilesFold = 32768u;        // workgroups along x of an indirect dispatch
const uint kNoTile = ~0u;              // in the list of live tiles, after the last one
const float kTileDead = kTraceTimeMax; // a tile's start where no ray of the tile can hit anything

// The beam grid: kBeamCells^3 cells over the octree's root cube and a border of one cell around it. A cell is set if it
// or one of its 26 neighbours touches an occupied part of the octree. Below the set cells lie finer ones, a quarter as
// large, set by the same rule with neighbours of their own size. It is stored as an octree whose nodes have room for
// all children: node 0 is the root, then come the nodes of levels 1, 2 and 3; those of parent p (in Morton order of its
// level) from 64 p on for its lower and 64 p + 32 on for its upper half.
const uint kBeamCells = 64u;
const uint kBeamLevels = 3u;     // of nodes; 4 for an octree with as many
const uint kBeamFirst1 = 1u;     // first node of level 1
const uint kBeamFirst2 = 65u;    // first node of level 2
const uint kBeamFirst3 = 4161u;  // first node of level 3
const uint kBeamNodes = 266305u; // of all levels
const uint kBeamRows = 4096u;    // of cells along x
const uint kBeamMasks = 4160u;   // of level 2, then of level 1
const uint kBeamGroup = 64u;     // threads of a workgroup of the kernels that build it

// Where rays may begin. The root cube is divided into kPathCells^3 cells, x in the lowest bits of their number. Each
// holds the nodes of levels 1 to 3 that contain it, 0 where there is none:
//
//     level 1: 8 bits | level 2: 16 | level 2 is relative: 1 | unused 7 | level 3: 32, from the lowest bit on
//
// Nodes of level 1, and of level 2 where its bit says so, are relative: counted from the node before the root's first
// child, or from the root if that has a list. Where all nodes stand level by level, that node is the root; level 1 is
// then at most 64, and level 2 at most 4160 and not relative. Where an update has merged a root, level 1 is at most 64,
// relative; level 2 is either at most 4160, relative, or a node of the base tree. So the nodes of every tree that zvo
// makes fit. A node that does not fit is left out with those below it, and rays begin above it.
const uint kPathLevels = 3u;
const uint kPathCellBits = 6u;
const uint kPathCells = 64u;
const uint kPathLevel1Bits = 8u;
const uint kPathLevel2Bits = 16u;
const uint kPathLevel2Shift = 8u;
const uint kPathRelativeShift = 24u;

// Where the ranks of hits in a DAG begin. Behind the nodes of all cells stand, for each cell, the node of level
// kPathLevels that contains it, and the number of voxels before those below that node:
//
//     node: 31 bits | it is an overlay's: 1 | voxels: 32, from the lowest bit on; 0 where there is no such node
//
// For a node of an overlay, voxels is its rank. The last element is the address of the overlays' ranks, by node.
const uint kRankTableFirst = kPathCells * kPathCells * kPathCells;
const uint kRankTableOverlays = 2u * kRankTableFirst;

// The light that arrives at a hit. Each part: 0 is none, 255 is all.
const uint kLightSun = 255u; // mask
const uint kLightSkyShift = 8u;
const uint kLightAll = 65535u;

// What a picture shows. The first is made by trace/shade; the others are values of a specialization constant of
// trace/views.
const uint kViewColor = 0u;      // lit
const uint kViewAlbedo = 1u;     // base colour alone
const uint kViewNormal = 2u;     // 0.5 + 0.5 * shading normal
const uint kViewDepth = 3u;      // from white to a dark grey over the depths of the grid
const uint kViewLevel = 4u;      // how much coarser than a voxel the hit is
const uint kViewIterations = 5u; // heat map, logarithmic up to 127
const uint kViewVoxel = 6u;      // a colour for each voxel, by its coordinates
const uint kViewBricks = 7u;     // base colour, with the borders of nodes
const uint kViewOrigin = 8u;     // grey: static; orange: in a leaf that a dynamic update made

// How a picture stores a pixel: a specialization constant of trace/shade, views and sky. All but the last hold sRGB
// codes.
const uint kTexelRgba8 = 0u; // red | green << 8 | blue << 16 | alpha << 24
const uint kTexelBgra8 = 1u; // blue | green << 8 | red << 16 | alpha << 24
const uint kTexelRgb10 = 2u; // red | green << 10 | blue << 20 | alpha << 30
const uint kTexelHalf = 3u;  // two words of half floats, red | green << 16 and blue | alpha << 16: linear

const float kHalfMax = 65504.0f; // largest half float

// The constants of every kernel with lib/traverse.glsl.
#define TRAVERSE_CONSTANTS                                                                                             \
    GPU_CONSTANT(uint, node_levels, 5u)                                                                                \
    GPU_CONSTANT(TraceStack, stack, kStackRegisters)                                                                   \
    GPU_CONSTANT(bool, detail, false)                                                                                  \
    GPU_CONSTANT(uint, iterations_max, kTraceIterationsMax)                                                            \
    GPU_CONSTANT(uint, entries_per_word, 0u)

// Of every kernel with trace/primary.glsl, behind those.
#define PRIMARY_CONSTANTS                                                                                              \
    GPU_CONSTANT(bool, orthographic, false)                                                                            \
    GPU_CONSTANT(bool, count_iterations, false)                                                                        \
    GPU_CONSTANT(bool, paths, false)                                                                                   \
    GPU_CONSTANT(bool, paths_relative, false)                                                                          \
    GPU_CONSTANT(bool, overlays, false)                                                                                \
    GPU_CONSTANT(bool, resume, false)                                                                                  \
    GPU_CONSTANT(bool, more, false)

struct RaysParams // push constants of trace/rays
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Ray) rays; // [ray_count]
    GPU_PTR(Hit) hits;       // [ray_count]
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) rounds; // [kTraceRoundsMax] cleared; kMore only
    vec2 detail;                  // as traverse()
    uint ray_count;
    uint round; // that unfinished rays wait for
};
GPU_KERNEL_BEGIN(trace, rays, Rays, RaysParams)
    TRAVERSE_CONSTANTS
    GPU_CONSTANT(bool, resume, false)
    GPU_CONSTANT(bool, more, false)
GPU_KERNEL_END

struct BeamMarkParams // push constants of trace/beam_mark: one thread a row
{
    GPU_CONST_PTR(Node) nodes;
    GPU_PTR(uint64_t) rows; // [cells * cells] of occupied cells: row y + z * cells
    uint levels;            // of nodes to look at
    uint cells;             // 4^levels, at most 64
};
GPU_KERNEL_BEGIN(trace, beam_mark, BeamMark, BeamMarkParams)
    GPU_CONSTANT(uint, entries_per_word, 0u)
GPU_KERNEL_END

struct BeamDilateParams // push constants of trace/beam_dilate: one thread a row
{
    GPU_CONST_PTR(uint64_t) occupied; // [cells * cells]
    GPU_PTR(uint64_t) rows;           // [kBeamRows] of the beam grid
    uint cells;
};
GPU_KERNEL(trace, beam_dilate, BeamDilate, BeamDilateParams)

struct BeamNodesParams // push constants of trace/beam_nodes: one thread a node, one workgroup its parent
{
    GPU_CONST_PTR(uint64_t) rows; // of the beam grid; level 2 only
    GPU_PTR(uint64_t) masks;      // [kBeamMasks] in Morton order of their level
    GPU_PTR(Node) nodes;          // [kBeamNodes]
};
GPU_KERNEL_BEGIN(trace, beam_nodes, BeamNodes, BeamNodesParams)
    GPU_CONSTANT(bool, level2, true)
GPU_KERNEL_END

struct BeamRefineParams // push constants of trace/beam_refine: one thread a cell of the beam grid
{
    GPU_CONST_PTR(Node) octree;
    GPU_CONST_PTR(uint64_t) masks;
    GPU_PTR(Node) nodes;
};
GPU_KERNEL_BEGIN(trace, beam_refine, BeamRefine, BeamRefineParams)
    GPU_CONSTANT(uint, entries_per_word, 0u)
GPU_KERNEL_END

struct BeamPathsParams // push constants of trace/beam_paths: one thread a cell
{
    GPU_CONST_PTR(Node) octree;
    GPU_PTR(uint64_t) paths; // [kPathCells^3]
};
GPU_KERNEL_BEGIN(trace, beam_paths, BeamPaths, BeamPathsParams)
    GPU_CONSTANT(uint, entries_per_word, 0u)
GPU_KERNEL_END

struct BeamRanksParams // push constants of trace/beam_ranks: one thread a cell
{
    RankSource source;
    GPU_CONST_PTR(BeforeChild) overlay_ranks; // by nodes of overlays; kOverlays only
    GPU_PTR(uint64_t) paths;                  // [kRankTableOverlays + 1]
};
GPU_KERNEL_BEGIN(trace, beam_ranks, BeamRanks, BeamRanksParams)
    GPU_CONSTANT(bool, leaves, false)
    GPU_CONSTANT(uint, entries_per_word, 2u)
    GPU_CONSTANT(bool, overlays, false)
GPU_KERNEL_END

struct RanksParams // push constants of trace/ranks
{
    RankSource source;
    GPU_CONST_PTR(BeforeChild) overlay_ranks; // by nodes of overlays; kOverlays only, like the last one
    GPU_CONST_PTR(uvec2) live;                // kTiles only
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
GPU_KERNEL_END

struct BeamParams // push constants of trace/beam: one thread a tile
{
    GPU_CONST_PTR(Node) nodes; // of the beam grid
    GPU_PTR(float) starts;     // [tiles] row by row: where its rays may start, or kTileDead
    GPU_PTR(uvec2) live; // [tiles] x | y << 16, bits of the start: of tiles that are not dead; filled with kNoTile
    GPU_PTR(DispatchArgs) args;  // [1] cleared; one workgroup a live tile
    GPU_PTR(TraceStatus) status; // [1]
    CameraRays camera;
    uint width; // pixels
    uint height;
    uint block_stride; // coprime to the number of blocks: the order in which they are taken
    vec2 detail;       // as traverse(), of the picture's rays
};
GPU_KERNEL_BEGIN(trace, beam, Beam, BeamParams)
    TRAVERSE_CONSTANTS
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(bool, beam, true)
    GPU_CONSTANT(bool, empty, false)
GPU_KERNEL_END

struct PrimaryParams // push constants of trace/primary
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint64_t) paths; // of trace/beam_paths; kPaths only
    GPU_CONST_PTR(uvec2) live;
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) rounds; // [kTraceRoundsMax] cleared; kMore only
    GPU_PTR(Hit) hits;            // [width * height] row by row, undefined in dead tiles
    GPU_PTR(uint) iterations;     // [width * height] likewise; kCountIterations only
    CameraRays camera;
    uint width;
    uint height;
    vec2 detail;
    uint round;
};
GPU_KERNEL_BEGIN(trace, primary, Primary, PrimaryParams)
    TRAVERSE_CONSTANTS
    PRIMARY_CONSTANTS
GPU_KERNEL_END

struct PrimaryRanksParams // push constants of trace/primary_ranks
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint64_t) paths; // of trace/beam_paths and trace/beam_ranks
    GPU_CONST_PTR(uvec2) live;
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) rounds;
    GPU_PTR(Hit) hits;
    GPU_CONST_PTR(BeforeChild) before; // this and the next as in RankSource
    GPU_CONST_PTR(uint) voxels_before_leaf;
    CameraRays camera;
    uint width;
    uint height;
    uint first_short_entry;
    uint round;
};
GPU_KERNEL_BEGIN(trace, primary_ranks, PrimaryRanks, PrimaryRanksParams)
    TRAVERSE_CONSTANTS
    PRIMARY_CONSTANTS
GPU_KERNEL_END

struct ShadowParams // push constants of trace/shadow
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(Attribute) attributes;      // of voxels, in the format of kFormat
    GPU_CONST_PTR(Attribute) node_attributes; // kDetail only
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) rounds; // [kTraceRoundsMax] cleared; kMore only
    GPU_PTR(uint) light;          // [width * height] light that arrives; undefined in dead tiles
    vec3 forward;                 // of the camera
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    vec3 to_sun; // length 1
    uint width;
    uint height;
    uint round;
};
GPU_KERNEL_BEGIN(trace, shadow, Shadow, ShadowParams)
    TRAVERSE_CONSTANTS
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(AttributeFormat, format, kFormat8)
    GPU_CONSTANT(bool, resume, false)
    GPU_CONSTANT(bool, more, false)
GPU_KERNEL_END

struct OcclusionParams // push constants of trace/occlusion
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(Attribute) attributes;
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_PTR(TraceStatus) status;
    GPU_PTR(uint) light;
    vec3 forward;
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    uint width;
    uint height;
    uint ray_count;
    float radius; // unit space
};
GPU_KERNEL_BEGIN(trace, occlusion, Occlusion, OcclusionParams)
    TRAVERSE_CONSTANTS
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(AttributeFormat, format, kFormat8)
    GPU_CONSTANT(bool, shadows, true)
GPU_KERNEL_END

struct SkyParams // push constants of trace/sky: one thread kSkyRows pixels of a column
{
    GPU_PTR(uint) image; // [width * height] texels of one word or two, as kTexels says
    vec3 forward;        // of the camera
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    vec3 to_sun; // length 1
    uint width;
    uint height;
    float sun; // strength
    float exposure;
};
GPU_KERNEL_BEGIN(trace, sky, Sky, SkyParams)
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(TexelFormat, texels, kTexelRgba8)
    GPU_CONSTANT(bool, black, false)
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

struct ShadeParams // push constants of trace/shade
{
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(uint) light;           // of trace/shadow and trace/occlusion; kLight only
    GPU_CONST_PTR(Attribute) attributes; // of voxels, as above
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_CONST_PTR(uvec2) emission_words;
    GPU_CONST_PTR(uint) emission;
    GPU_PTR(uint) image; // as in SkyParams
    vec3 forward;
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    vec3 sun; // towards it, as long as it is strong
    uint width;
    uint height;
    float emission_scale;
    float exposure;
};
GPU_KERNEL_BEGIN(trace, shade, Shade, ShadeParams)
    GPU_CONSTANT(uint, node_levels, 5u)
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(AttributeFormat, format, kFormat8)
    GPU_CONSTANT(bool, emission, false)
    GPU_CONSTANT(bool, light, true)
    GPU_CONSTANT(TexelFormat, texels, kTexelRgba8)
GPU_KERNEL_END

struct ViewsParams // push constants of trace/views
{
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(uint) iterations;      // of trace/primary; kViewIterations only
    GPU_CONST_PTR(Attribute) attributes; // of voxels, as above
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_PTR(uint) image; // as in SkyParams
    vec3 forward;
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    vec2 depth_range;         // kViewDepth only: the depth that is white, and the one that is dark
    uint first_changed_voxel; // kViewOrigin only: the first index of an attribute that is not a static voxel's
    uint first_changed_node;  // likewise, of nodes
    uint width;
    uint height;
};
GPU_KERNEL_BEGIN(trace, views, Views, ViewsParams)
    GPU_CONSTANT(View, view, kViewAlbedo)
    GPU_CONSTANT(uint, node_levels, 5u)
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(AttributeFormat, format, kFormat8)
    GPU_CONSTANT(TexelFormat, texels, kTexelRgba8)
GPU_KERNEL_END

GPU_NAMESPACE_END

#endif
