// SPDX-License-Identifier: MIT
// The index of the attributes of a hit in a DAG. The includer includes lib/hit.glsl, lib/morton.glsl and lib/ranks.glsl
// before and declares kNodeLevels, kDetail and kOverlays.
//
// Overlays (update/update.h) may stand above the DAG. Their nodes have attributes of their own, and so have the voxels
// in their leaves, whose numbers the traversal has found already. What hangs below a list begins with the rank of the
// node that the overlay's is a copy of.
#ifndef ZVO_SHADERS_TRACE_HIT_RANK_GLSL
#define ZVO_SHADERS_TRACE_HIT_RANK_GLSL

#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/ranks.glsl"
#include "shared/svdag.h"
#include "shared/trace.h"

// The number in its block of the cell, at some level, that contains a cell of a lower one.
uint cellAt(uvec3 cell, uint cell_level, uint level)
{
    return cellInBlock(cell >> (2u * (cell_level - level)));
}

// hit: as a traversal leaves it, with the number of the voxel in its leaf as its index.
uint attributeIndex(RankSource source, BeforeChild_ConstPtr overlay_ranks, uint attribute_offset, Hit hit)
{
    uvec3 cell = hitCell(hit);
    uint level = kDetail ? hitLevel(hit) : kNodeLevels;
    RankedNode at = RankedNode(0u, 0u, 0u);
    bool in_overlay = kOverlays;
    for (uint above = 0u; above + 2u < kNodeLevels; ++above)
    {
        if (above < level)
        {
            uint child = cellAt(cell, level, above + 1u);
            in_overlay = in_overlay && descendInOverlay(source, overlay_ranks, child, at);
            if (!in_overlay)
                descend(source, child, at);
        }
    }
    if (level + 1u >= kNodeLevels)
    {
        uint leaf = cellAt(cell, level, kNodeLevels - 1u);
        in_overlay = in_overlay && descendInOverlay(source, overlay_ranks, leaf, at);
        if (!in_overlay)
            descendToLeaf(source, leaf, kDetail, at);
    }
    uint voxel = hit.index + (in_overlay ? 0u : at.voxels);
    uint node = in_overlay ? at.node + attribute_offset : at.rank;
    return level == kNodeLevels ? voxel : node;
}

#endif
