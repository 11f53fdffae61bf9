// SPDX-License-Identifier: MIT
// What the kernels that find where rays may begin below the root share with the host.
#ifndef ZVO_SHADERS_TRACE_NODE_PATHS_H
#define ZVO_SHADERS_TRACE_NODE_PATHS_H

#include "trace/trace.h"

GPU_NAMESPACE_BEGIN

const uint kPathsGroup = 64u; // threads of a workgroup of these kernels

// Where rays may begin. The root cube is divided into kPathCells^3 cells, x in the lowest bits of their number. Each
// holds the references of the nodes of levels 1 to 3 that contain it, 0 where there is none:
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

struct NodePathsParams // push constants of trace/node_paths: one thread a cell
{
    GPU_CONST_PTR(Node) octree;
    GPU_PTR(uint64_t) paths; // [kPathCells^3]
};
#define TRACE_NODE_PATHS_CONSTANTS(CONSTANT)                                                                           \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 0u) /* of lists; 0: there are none */
GPU_KERNEL(trace, node_paths, NodePaths, NodePathsParams, TRACE_NODE_PATHS_CONSTANTS)

struct NodeRanksParams // push constants of trace/node_ranks: one thread a cell
{
    RankSource source;
    GPU_CONST_PTR(BeforeChild) overlay_ranks; // by nodes of overlays; kOverlays only
    GPU_PTR(uint64_t) paths;                  // [kRankTableOverlays + 1]
};
#define TRACE_NODE_RANKS_CONSTANTS(CONSTANT)                                                                           \
    CONSTANT(0, bool, leaves, kLeaves, false)                /* the nodes of level kPathLevels are leaves */           \
    CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 2u) /* of lists */                                            \
    CONSTANT(2, bool, overlays, kOverlays, false)            /* the upper nodes may be those of an overlay */
GPU_KERNEL(trace, node_ranks, NodeRanks, NodeRanksParams, TRACE_NODE_RANKS_CONSTANTS)

GPU_NAMESPACE_END

#endif
