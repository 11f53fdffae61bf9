#version 460
// SPDX-License-Identifier: MIT
// Finds the base tree's node of each cell, and what the brush does to the leaves among them.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditFindParams, EDIT_FIND_CONSTANTS);
layout(local_size_x = kNodesGroup) in;

#include "edit/cells.glsl"
#include "lib/dispatch.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ranks.glsl"

const bool kRanks = kEntriesPerWord != 0u && kAttributes;

// The base tree's node of a cell, or kNoEditNode.
RankedNode baseNode(uint level, uvec3 cell)
{
    RankSource source =
        RankSource(params.nodes, params.before, params.voxels_before_leaf, params.first_short_entry);
    RankedNode at = RankedNode(params.root, 0u, kEntriesPerWord == 0u ? octreeRank(source, params.root) : 0u);
    for (uint l = 0u; l < level && at.node != kNoEditNode; ++l)
    {
        uint child = cellInBlock(cell >> (2u * (level - 1u - l)));
        bool exists = hasCell(nodeMask(params.nodes, at.node), child);
        if (exists)
            descendBase(source, params.ranks, child, l + 2u == params.box.level_count, kRanks, at);
        at.node = exists ? at.node : kNoEditNode;
    }
    return at;
}

// Squares of the distances from the brush's centre, along an axis, of the four voxels that begin at `first`; 0 if only
// the box counts. Voxels outside of the box are too far away.
ivec4 axisSquares(int first, uint lo, uint hi, int center, bool is_box, int limit)
{
    ivec4 voxel = first + ivec4(0, 1, 2, 3);
    ivec4 away = voxel - center;
    ivec4 squares = is_box ? ivec4(0) : away * away;
    uvec4 inside = uvec4(greaterThanEqual(voxel, ivec4(lo))) & uvec4(lessThanEqual(voxel, ivec4(hi)));
    return mix(ivec4(limit + 1), squares, notEqual(inside, uvec4(0u)));
}

// The mask of a leaf's voxels that the brush covers, as isUnderBrush() says, within a part of the dab's box. more: what
// its radius grows by. leaf: among leaves.
uvec2 voxelsUnderBrush(uvec3 leaf, uvec3 lo, uvec3 hi, int more)
{
    bool is_box = shapeOf(params.brush) == kBrushBox;
    int radius = radiusOf(params.brush) + more;
    int limit = is_box ? 0 : radius * (radius + 1);
    ivec3 first = 4 * ivec3(leaf);
    ivec3 center = params.brush.lo + radiusOf(params.brush);
    ivec4 x = axisSquares(first.x, lo.x, hi.x, center.x, is_box, limit);
    ivec4 y = axisSquares(first.y, lo.y, hi.y, center.y, is_box, limit);
    ivec4 z = axisSquares(first.z, lo.z, hi.z, center.z, is_box, limit);
    uvec2 under = uvec2(0u);
    [[unroll]] for (uint row = 0u; row < 16u; ++row)
    {
        uvec4 covered = uvec4(lessThanEqual(x, ivec4(limit - y[row & 3u] - z[row >> 2])));
        uint shift = cellInBlock(uvec3(0u, row & 3u, row >> 2));
        uint cells = covered.x | (covered.y << 1) | (covered.z << 8) | (covered.w << 9); // by Morton codes of x
        under.x |= shift < 32u ? cells << shift : 0u;
        under.y |= shift < 32u ? 0u : cells << (shift - 32u);
    }
    return under;
}

// The mask of a stamp's voxels in a leaf.
uvec2 stampOf(uint leaf)
{
    return uvec2(params.stamp.data[stampMask(leaf, 0u)], params.stamp.data[stampMask(leaf, 32u)]);
}

// The voxels of a leaf that a brush which carves may lay bare: all close to a brush, and to a stamp those of leaves that
// it has voxels in, or in a neighbour by a face. number: of the leaf among the cells that are leaves.
uvec2 voxelsNearBrush(uvec3 leaf, uint number)
{
    if (!kStamp)
        return voxelsUnderBrush(leaf, params.box.lo, params.box.hi, 1);
    uint level = params.box.level_count - 1u;
    uvec2 near = stampOf(number);
    [[unroll]] for (uint side = 0u; side < 6u; ++side)
    {
        uvec3 beside = besideFace(leaf, side);
        if (isInBox(params.box, level, beside))
            near |= stampOf(cellNumber(params.box, level, beside));
    }
    return (near.x | near.y) != 0u ? uvec2(~0u) : uvec2(0u);
}

// Computes the leaf's mask after the dab, whether the mask or a voxel changes, and how many voxels more there are then.
// number: of the leaf among the cells that are leaves. own: all of its voxels have attributes, which a brush gave them.
void dab(uvec3 leaf, uint number, bool own, inout EditCell cell)
{
    uvec2 mask = uvec2(cell.before_lo, cell.before_hi);
    uvec2 under =
        voxelsUnderBrush(leaf, boxLow(params.brush, params.box), boxHigh(params.brush, params.box), 0);
    if (kStamp)
        under &= stampOf(number);
    uint action = actionOf(params.brush);
    bool paints = action == kBrushPaint || (kStamp && action == kBrushFill);
    uvec2 made = action == kBrushFill ? under & ~mask : uvec2(0u);
    uvec2 taken = action == kBrushCarve ? under & mask : uvec2(0u);
    uvec2 painted = paints && kAttributes ? under & mask : uvec2(0u);
    uvec2 touched = made | taken | painted;
    if (kExposes) // all that may be laid bare, and has no attributes or may lack a normal
    {
        uvec2 without = own ? mask : mask & ~uvec2(cell.surface_lo, cell.surface_hi);
        touched |= voxelsNearBrush(leaf, number) & without;
    }
    cell.mask_lo = (mask.x | made.x) & ~taken.x;
    cell.mask_hi = (mask.y | made.y) & ~taken.y;
    cell.changed = (touched.x | touched.y) != 0u ? 1u : 0u;
    cell.first = bitCount(made.x) + bitCount(made.y) - bitCount(taken.x) - bitCount(taken.y);
}

// What the brush makes of a leaf.
void findLeaf(RankedNode at, uvec3 position, uint number, inout EditCell cell)
{
    uvec2_ConstPtr leaf_groups = uvec2_ConstPtr(kEntriesPerWord == 0u ? uint64_t(params.before) : 0ul);
    bool own = false;
    if (at.node != kNoEditNode)
    {
        Node surface = loadSurfaceOf(params.nodes, leaf_groups, at.node);
        cell.before_lo = cell.mask_lo;
        cell.before_hi = cell.mask_hi;
        cell.voxels = at.voxels + surface.base_lo;
        cell.surface_lo = surface.mask_lo;
        cell.surface_hi = surface.mask_hi;
        own = !isLeafWord(at.node) && !isFullNode(loadInner(params.nodes, at.node).base_lo);
    }
    dab(position, number, own, cell);
}

void main()
{
    uint index = threadIndex();
    uint number = index;
    uint level = levelOf(params.box, number);
    if (level == params.box.level_count)
        return;
    uvec3 position = cellOf(params.box, level, number);
    RankedNode at = baseNode(level, position);
    uvec2 mask = uvec2(0u);
    if (at.node != kNoEditNode)
        mask = nodeMask(params.nodes, at.node);
    EditCell cell = unchangedCell(at.node, at.voxels, at.rank, mask);
    if (level + 1u == params.box.level_count)
        findLeaf(at, position, number, cell);
    params.cells.data[index] = cell;
}
