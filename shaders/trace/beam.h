// SPDX-License-Identifier: MIT
// What the kernels that find where rays may begin share with the host: the beam grid, paths and ranks.
#ifndef ZVO_SHADERS_TRACE_BEAM_H
#define ZVO_SHADERS_TRACE_BEAM_H

#include "trace/trace.h"

GPU_NAMESPACE_BEGIN

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
const uint kBeamBlocks = 4096u;  // nodes of level 2: blocks of 4x4x4 cells
const uint kBeamMasks = 4160u;   // of nodes of level 2, then of level 1, in Morton order
const uint kBeamBlocksMax = 32u; // that a workgroup refines: the children in half a node of level 1
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

struct BeamNodesParams // push constants of trace/beam_nodes: one thread a node of level 2, one workgroup its parent
{
    GPU_CONST_PTR(Node) octree;
    GPU_PTR(uint64_t) masks; // [kBeamMasks]
    GPU_PTR(Node) nodes;     // [kBeamNodes]
};
GPU_KERNEL_BEGIN(trace, beam_nodes, BeamNodes, BeamNodesParams)
    GPU_CONSTANT(uint, entries_per_word, 0u)
    GPU_CONSTANT(uint, levels, 3u)
GPU_KERNEL_END

struct BeamRefineParams // push constants of trace/beam_refine: one workgroup for the top, others for kBlocks nodes each
{
    GPU_CONST_PTR(Node) octree;
    GPU_CONST_PTR(uint64_t) masks;
    GPU_PTR(Node) nodes;
};
GPU_KERNEL_BEGIN(trace, beam_refine, BeamRefine, BeamRefineParams)
    GPU_CONSTANT(uint, entries_per_word, 0u)
    GPU_CONSTANT(uint, blocks, 1u)
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

GPU_NAMESPACE_END

#endif
