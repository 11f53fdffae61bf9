#version 460
// SPDX-License-Identifier: MIT
// Makes the parents of the cells of a level: the first cell of each collects the others, which follow it. Of an octree
// that is the nodes; of a DAG, the candidates of which equal ones are merged.
#extension GL_GOOGLE_include_directive : require
#include "baseline/slides.h"

GPU_ENTRY(SlidesParentsParams, BASELINE_SLIDES_PARENTS_CONSTANTS);
layout(local_size_x = kSlidesGroup) in;

#include "baseline/slides_leaders.glsl"
#include "lib/dispatch.glsl"

const bool kHasSums = kNodeWords == kSlidesSumNodeWords;

void makeParent(uint64_t parent, uint first_cell, uint place)
{
    uint words = place * kNodeWords;
    uint cell = first_cell;
    uint mask = 0u;
    uint voxels = 0u;
    for (uint octant = 0u; octant < 8u; ++octant)
    {
        uint at = min(cell, params.cell_count - 1u);
        bool exists = cell < params.cell_count && params.codes.data[at] == (parent << 3 | octant);
        uint child = kSlidesNoNode;
        if (!kLeaves && exists)
            child = params.children.data[at];
        params.nodes.data[words + 1u + octant] = child;
        if (kHasSums)
        {
            params.nodes.data[words + 9u + octant] = voxels;
            if (exists)
                voxels += kLeaves ? 1u : params.voxels.data[at];
        }
        mask |= exists ? 1u << octant : 0u;
        cell += exists ? 1u : 0u;
    }
    params.nodes.data[words] = mask;
    params.parent_codes.data[place] = parent;
    if (kHasSums)
        params.parent_voxels.data[place] = voxels;
    if (!kDag)
        params.parent_nodes.data[place] = params.first_node + place;
}

void main()
{
    uint first = threadIndex() * kSlidesItems;
    SlidesCodes codes = loadCodes(params.codes, first, params.cell_count);
    uint leaders = leadersOf(codes, first, params.cell_count, 3u);
    uint place = placeOfKept(leaders, params.cell_count, params.partials);
    for (; leaders != 0u; leaders &= leaders - 1u)
    {
        uint cell = first + uint(findLSB(leaders));
        makeParent(params.codes.data[cell] >> 3, cell, place);
        ++place;
    }
}
