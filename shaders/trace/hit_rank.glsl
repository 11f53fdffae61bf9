// SPDX-License-Identifier: MIT
// The rank of a hit in a DAG: the index of its attributes, from the number of the voxel in its leaf, which is all that
// a traversal of a DAG knows.
// Needs the constants kNodeLevels, kDetail and kEntriesPerWord.
//
// Overlays (update/update.h) may stand above the DAG. Their nodes have attributes of their own, and so have the voxels
// in their leaves, whose numbers the traversal has found already. What hangs below a list begins with the rank of the
// node that the overlay's is a copy of.
#ifndef ZVO_SHADERS_TRACE_HIT_RANK_GLSL
#define ZVO_SHADERS_TRACE_HIT_RANK_GLSL

#include "lib/morton.glsl"
#include "lib/ranks.glsl"
#include "shared/svdag.h"

// The number in its block of the cell, at some level, that contains a cell of a lower one.
uint cellAt(uvec3 cell, uint cell_level, uint level)
{
    return cellInBlock(cell >> (2u * (cell_level - level)));
}

// Goes down the path of a hit from a node of level `from`, to the parent of the leaf or to the node of level `to`, if
// that comes first. cell, cell_level: of the hit. in_overlay: the node that is reached is an overlay's, with a rank of
// its own.
void descendToHit(RankSource source, BeforeChild_ConstPtr overlay_ranks, uvec3 cell, uint cell_level, uint from,
                  uint to, inout bool in_overlay, inout RankedNode at)
{
    for (uint above = from; above + 2u < kNodeLevels; ++above)
    {
        if (above < to)
        {
            uint child = cellAt(cell, cell_level, above + 1u);
            in_overlay = in_overlay && descendInOverlay(source, overlay_ranks, child, at);
            if (!in_overlay)
                descend(source, child, at);
        }
    }
}

// level: of the hit. in_overlay: the root may be an overlay's. index: as the traversal leaves it, the number of the
// voxel in its leaf, or kInteriorIndex.
uint attributeIndex(RankSource source, BeforeChild_ConstPtr overlay_ranks, bool in_overlay, uint attribute_offset,
                    uvec3 cell, uint level, uint index)
{
    RankedNode at = RankedNode(0u, 0u, 0u);
    descendToHit(source, overlay_ranks, cell, level, 0u, level, in_overlay, at);
    if (level + 1u >= kNodeLevels)
    {
        uint leaf = cellAt(cell, level, kNodeLevels - 1u);
        in_overlay = in_overlay && descendInOverlay(source, overlay_ranks, leaf, at);
        if (!in_overlay)
            descendToLeaf(source, leaf, kDetail, at);
    }
    uint voxel = voxelRank(index, in_overlay ? 0u : at.voxels);
    uint node = in_overlay ? at.node + attribute_offset : at.rank;
    return level == kNodeLevels ? voxel : node;
}

#endif
