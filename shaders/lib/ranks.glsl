// SPDX-License-Identifier: MIT
// Ranks in a DAG (shared/svdag.h): of voxels in Morton order, of the octree's nodes depth first. Both are sums along
// the path from the root. Overlays (update/update.h) may stand above a DAG: their nodes have ranks of their own.
// Needs the constant kEntriesPerWord, of lists.
// RANKS_BINDING (optional): the binding of voxels_before_leaf in the kernel's bound form (lib/bound.glsl).
#ifndef ZVO_SHADERS_LIB_RANKS_GLSL
#define ZVO_SHADERS_LIB_RANKS_GLSL

#include "lib/bound.glsl"
#include "lib/node.glsl"
#include "shared/svdag.h"

// A node of the octree by its path.
struct RankedNode
{
    uint node;   // reference
    uint voxels; // before those below it
    uint rank;   // depth first; kInteriorIndex or more below a full node
};

// The index of the entry that names the child in a cell.
uint entryIndex(RankSource source, uint node, uint cell)
{
    uvec2 half_node = unpackUint2x32(uint64_t_ConstPtr(uint64_t(source.pool)).data[2u * node + (cell >> 5)]);
    return (half_node.y & ~kListFlags) + bitCount(half_node.x & ((1u << (cell & 31u)) - 1u));
}

// From a node above the parents of leaves to the child in a cell.
void descend(RankSource source, uint cell, inout RankedNode at)
{
    uint index = entryIndex(source, at.node, cell);
    uvec2 before = unpackUint2x32(uint64_t_ConstPtr(uint64_t(source.before)).data[index]);
    at.node = listEntry(uint64_t_ConstPtr(uint64_t(source.pool)), index, kEntriesPerWord);
    at.voxels += before.x;
    uint below_full = isFilledDag(kEntriesPerWord) ? (at.rank | before.y) & kInteriorIndex : 0u;
    at.rank = (at.rank + 1u + before.y) | below_full;
}

// From a node of an overlay to the child in a cell, unless that stands in a list of the DAG below.
bool descendInOverlay(RankSource source, BeforeChild_ConstPtr overlay_ranks, uint cell, inout RankedNode at)
{
    uint index = childIndex(source.pool.data[at.node], cell);
    bool direct = (index & kChildList) == 0u;
    if (direct)
    {
        BeforeChild rank = overlay_ranks.data[index];
        at = RankedNode(index, rank.voxels, rank.nodes);
    }
    return direct;
}

#if defined(BOUND) && defined(RANKS_BINDING)
TEXELS_1(RANKS_BINDING, voxels_before_leaf);

uint loadBeforeLeaves(RankSource source, uint i)
{
    return texelFetch(texels1_voxels_before_leaf, int(i)).x;
}
#else
uint loadBeforeLeaves(RankSource source, uint i)
{
    return source.voxels_before_leaf.data[i];
}
#endif

// Voxels before a leaf in its parent; the entry with this index names the leaf.
uint voxelsBeforeLeaf(RankSource source, uint index)
{
    uint entry = index - source.first_short_entry;
    return bitfieldExtract(loadBeforeLeaves(source, entry >> 1), int(16u * (entry & 1u)), 16);
}

// The index of a voxel's attributes. index: as the traversal leaves it; before: voxels before those of its leaf.
uint voxelRank(uint index, uint before)
{
    return isFilledDag(kEntriesPerWord) && index >= kInteriorIndex ? kInteriorIndex : index + before;
}

// From a parent of leaves to the leaf in a cell, whose node is not looked up.
void descendToLeaf(RankSource source, uint cell, bool with_rank, inout RankedNode at)
{
    uint index = entryIndex(source, at.node, cell);
    if (isFilledDag(kEntriesPerWord) && index < source.first_short_entry) // of a full node
    {
        at.rank |= kInteriorIndex;
        return;
    }
    at.voxels += voxelsBeforeLeaf(source, index);
    if (with_rank)
        at.rank += 1u + index - entryIndex(source, at.node, 0u);
}

// The index of the attributes of an octree's node that is not full.
uint octreeRank(RankSource source, uint reference)
{
    return nodeIndexOf(uvec2_ConstPtr(uint64_t(source.before)), reference);
}

// From a node of a base tree, which may have been edited (edit/edit.h), to the child in a cell, which must exist.
// ranked: ranks are kept, as for a DAG with attributes. Otherwise, in an octree, a node's rank is the index of its
// attributes, of a full node that of the lowest other node around it; and voxels stay 0.
void descendBase(RankSource source, BeforeChild_ConstPtr overlay_ranks, uint cell, bool to_leaf, bool ranked,
                 inout RankedNode at)
{
    uint index = childIndex(loadInner(source.pool, at.node), cell);
    if (!ranked && kEntriesPerWord == 0u)
    {
        at = RankedNode(index, 0u, isFullNode(index) ? at.rank : octreeRank(source, index));
        return;
    }
    if (!ranked)
    {
        at = RankedNode(listedChild(source.pool, index, kEntriesPerWord), 0u, 0u);
        return;
    }
    if (descendInOverlay(source, overlay_ranks, cell, at))
        return;
    uint child = listedChild(source.pool, index, kEntriesPerWord);
    if (to_leaf)
        descendToLeaf(source, cell, true, at);
    else
        descend(source, cell, at);
    at.node = child;
}

#endif
