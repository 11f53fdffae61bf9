#version 460
// SPDX-License-Identifier: MIT
// Makes a level of nodes from the level below: a thread takes a cell and its eight children. If one of them is
// occupied, a tile is allocated, the children go there, and the cell becomes a node that points to them, with their
// mean.
//
// With kMerge, what is built are the voxels of a dynamic object, behind the nodes of a static octree. The thread
// searches the static octree for the node at its cell, copies those of its children where the object has nothing, and
// so merges both. Copies point to the static nodes below them. Where both have a voxel, the object's counts. The thesis
// builds the object's octree first, then searches, copies and merges; here these are steps of the same pass, which
// saves passes.
#extension GL_GOOGLE_include_directive : require
#include "baseline/thesis.h"

GPU_ENTRY(ThesisLevelParams, BASELINE_THESIS_LEVEL_CONSTANTS);
layout(local_size_x = kThesisLevelGroup) in;

#define SCAN_GROUP kThesisLevelGroup
#include "baseline/mean.glsl"
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"
#include "baseline/thesis_cells.glsl"

// The first child of the static node at a cell; 0 if there is none.
uint staticTile(uint cell)
{
    uint tile = params.nodes.data[params.static_root].child;
    for (uint level = 0u; level < params.level && tile != 0u; ++level)
        tile = params.nodes.data[tile + ((cell >> (3u * (params.level - 1u - level))) & 7u)].child;
    return tile;
}

// The tile below a cell, by number in the octree: levels stand behind each other, the lowest first. rank: of the tile
// in its level, without kAtomic.
uint numberTile(uint rank)
{
    uint tile = kAtomic ? atomicAdd(params.tiles.data[params.level], 1u) : rank;
    for (uint level = params.level + 1u; level < params.depth; ++level)
        tile += params.tiles.data[level];
    return tile;
}

void main()
{
    uint index = threadIndex();
    bool inside = index < params.cell_count;
    uint cell = params.first_cell + index;
    bool occupied = false;
    PointerNode children[kTileNodes];
    [[unroll]] for (uint i = 0u; i < kTileNodes; ++i)
    {
        children[i] = PointerNode(0u, 0u, 0u);
        if (inside)
            children[i] = loadChild(kTileNodes * cell + i);
        occupied = occupied || children[i].child != 0u;
    }
    uint rank = 0u;
    if (!kAtomic)
    {
        uint total;
        rank = workgroupExclusiveAdd(occupied ? 1u : 0u, total);
        if (inside)
            rank += params.partials.data[workgroupIndex()];
    }
    if (!inside)
        return;

    PointerNode node = PointerNode(0u, 0u, 0u);
    if (occupied)
    {
        uint static_tile = kMerge ? staticTile(cell) : 0u;
        uint first = params.root + 1u + kTileNodes * numberTile(rank);
        bool fits = first + kTileNodes <= params.node_capacity;
        MeanSums sums = noSums();
        [[unroll]] for (uint i = 0u; i < kTileNodes; ++i)
        {
            if (children[i].child == 0u && static_tile != 0u)
                children[i] = params.nodes.data[static_tile + i];
            addToMean(children[i], sums);
            if (fits)
                params.nodes.data[first + i] = children[i];
        }
        node = meanNode(sums, first);
    }
    params.parents.data[cell] = node;
    if (params.level == 0u && params.root < params.node_capacity)
    {
        if (kMerge && !occupied)
            node = params.nodes.data[params.static_root];
        params.nodes.data[params.root] = node;
    }
}
