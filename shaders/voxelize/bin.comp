#version 460
// SPDX-License-Identifier: MIT
// Sets triangles up, and makes their items, a thread a triangle. The voxels of small ones are found here, in 32-bit
// integers; they have an item in each brick with one of them, mostly a single brick, and many have no voxel at all.
// Large ones are listed for voxelize/bin_large, in blocks of columns of bricks.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BinParams, VOXELIZE_BIN_CONSTANTS);
layout(local_size_x = kChunkTriangles) in;

const uint kCoverage = kCoverageThin;
const bool kThin = true;
const uint kMode = kModeAttributes;
const bool kEmits = false;

#define BRICKS_BINDING 0
#define COLOR_BINDING 15
#define EDGE_INT int
#define EDGE_IVEC3 ivec3
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/item_voxels.glsl"
#include "voxelize/bin.glsl"
#include "voxelize/chunk.glsl"
#include "voxelize/dropped.glsl"
#include "voxelize/setup.glsl"
#include "voxelize/surface.glsl"
#include "voxelize/snap.glsl"

// Four words of the setups.
#ifdef BOUND
STORAGE(17, uvec4, setups);
STORAGE(18, uvec4, surfaces);
#define STORED_SETUP(I) storage_setups.data[I]
#define STORED_SURFACE(I) storage_surfaces.data[I]
#else
#define STORED_SETUP(I) uvec4_Ptr(uint64_t(params.setups)).data[I]
#define STORED_SURFACE(I) uvec4_Ptr(uint64_t(params.surfaces)).data[I]
#endif

ivec3 extentOf(SnappedTriangle t)
{
    return max(t.v0, max(t.v1, t.v2)) - min(t.v0, min(t.v1, t.v2));
}

// Blocks are those of the projection along the major axis, row by row.
void listLarge(SnappedTriangle snapped, uint axis, uint triangle)
{
    ivec3 size = (snapped.high >> int(kBrickLog2)) - (snapped.low >> int(kBrickLog2)) + 1;
    uvec2 blocks = (uvec2(permuted(size, axis).xy) + (kBlockBricks - 1u)) / kBlockBricks;
    uint count = blocks.x * blocks.y;
    ivec3 extent = extentOf(snapped);
    if (max(extent.x, max(extent.y, extent.z)) > kTileExtent || count > kBlocksMax)
    {
        atomicAdd(params.counters.data[0].wide_count, 1u);
        return;
    }
    uint first = atomicAdd(params.counters.data[0].large_count, count);
    if (first > kRowBlocksMax)
        atomicMax(params.counters.data[0].wide_count, 1u); // before large_count wraps around
    for (uint block = 0u; block < count; ++block)
        if (first + block < params.large_capacity)
            params.large.data[first + block] = LargeBlock(triangle, block);
}

// Whether the triangle is short, in the grid and beyond, and has few columns.
bool isSmall(SnappedTriangle t)
{
    ivec3 extent = extentOf(t);
    ivec3 size = t.high - t.low + 1;
    int least = min(size.x, min(size.y, size.z));
    int most = max(size.x, max(size.y, size.z));
    int middle = size.x + size.y + size.z - least - most;
    return max(extent.x, max(extent.y, extent.z)) <= kSmallExtent && most <= 1 << kBrickLog2 &&
           most * middle <= int(kItemColumns);
}

// Of what the triangle's surface needs, all that fragments do not change.
void writeSetup(uint place, Surface surface, RasterTriangle t, uint material)
{
    uint flags = t.axis | (t.mirror.x != 0 ? kSetupMirrorU : 0u) | (t.mirror.y != 0 ? kSetupMirrorV : 0u) |
                 (t.exchanged ? kSetupExchanged : 0u) | (surface.textured ? kSetupTextured : 0u) |
                 (surface.colored ? kSetupColored : 0u);
    if (surface.textured)
        flags |= surface.texture.wrap_u << kSetupWrapU | surface.texture.wrap_v << kSetupWrapV;
    ivec3 n0 = surface.normals[0];
    ivec3 n1 = surface.normals[1];
    ivec3 n2 = surface.normals[2];
    STORED_SETUP(4u * place) = uvec4(t.u, t.v.x);
    STORED_SETUP(4u * place + 1u) = uvec4(t.v.yz, t.w.xy);
    STORED_SETUP(4u * place + 2u) = uvec4(t.w.z, pack16(n0.x, n0.y), pack16(n0.z, n1.x), pack16(n1.y, n1.z));
    STORED_SETUP(4u * place + 3u) = uvec4(pack16(n2.x, n2.y), pack16(n2.z, 0), material, flags);
    if (surface.textured || surface.colored)
    {
        STORED_SURFACE(4u * place) = uvec4(surface.uvs.u, surface.uvs.v.x);
        STORED_SURFACE(4u * place + 1u) = uvec4(surface.uvs.v.yz, surface.level_number, surface.colors[0].x);
        STORED_SURFACE(4u * place + 2u) = uvec4(surface.colors[0].y, surface.colors[1], surface.colors[2].x);
        STORED_SURFACE(4u * place + 3u) = uvec4(surface.colors[2].y, 0u, 0u, 0u);
    }
}

struct SmallVoxels
{
    ItemVoxels voxels; // of all bricks
    uvec3 upper;       // those in the second brick along u, v, w, a bit a column
};

// The voxels of a small triangle. selected: else none.
SmallVoxels coverSmall(RasterTriangle t, bool selected)
{
    SmallVoxels found = SmallVoxels(noVoxels(t), uvec3(0u));
    uvec2 size = uvec2(t.high.xy - t.low.xy + 1);
    uint column_count = selected ? size.x * size.y : 0u;
    uint row_end = size.x;
    ivec3 first_brick = t.low >> int(kBrickLog2);
    ivec2 place = t.low.xy;
    RasterCell row = startColumn(t, place);
    RasterCell cell = row;
    for (uint column = 0u; column < column_count;)
    {
        addVoxel(isCovered(t, cell), column, cell.w, found.voxels);
        bvec3 is_upper = notEqual(ivec3(place, cell.w) >> int(kBrickLog2), first_brick);
        found.upper |= uvec3(is_upper) << column;
        ++column;
        ++place.x;
        nextColumn(t, cell);
        if (column == row_end)
        {
            nextRow(t, row);
            cell = row;
            place = ivec2(t.low.x, place.y + 1);
            row_end += size.x;
        }
    }
    return found;
}

// The columns that are in a brick of the eight, or not.
uint columnsIn(SmallVoxels found, uint brick)
{
    uvec3 others = found.upper ^ uvec3((brick & 1u) - 1u, ((brick >> 1) & 1u) - 1u, (brick >> 2) - 1u);
    return found.voxels.info & others.x & others.y & others.z & kColumnsMask;
}

void takeTriangle(ChunkTriangle taken)
{
    uvec3 vertices = loadTriangle(taken.draw.first_triangle + taken.triangle);
    SnappedTriangle snapped = snapTriangle(taken.draw, vertices, true);
    if (taken.exists)
        countDropped(snapped.fate);
    bool kept = taken.exists && snapped.fate == kKept && all(lessThanEqual(snapped.low, snapped.high));
    bool small = isSmall(snapped);
    uint axis = majorAxis(snapped.normal, snapped.low, snapped.high);
    RasterTriangle t = setupTriangle(snapped.v0, snapped.v1, snapped.v2, snapped.normal, axis, snapped.low,
                                     snapped.high, gridResolution());
    SmallVoxels found = coverSmall(t, kept && small);
    uint bricks = 0u; // bit u + 2 v + 4 w
    [[unroll]] for (uint brick = 0u; brick < 8u; ++brick)
        bricks |= columnsIn(found, brick) != 0u ? 1u << brick : 0u;
    uint count = bitCount(bricks);
    uint total = subgroupAdd(count);
    uint place = subgroupExclusiveAdd(count);
    uint first = 0u;
    if (subgroupElect() && total != 0u)
        first = addItems(total);
    place += subgroupBroadcastFirst(first);
    bool large = kept && !small;
    if (bricks != 0u || large)
    {
        float double_area = float(abs(permuted(snapped.normal, axis).z)); // in the projection along the major axis
        Surface surface = loadSurface(taken.draw, vertices, vec3(snapped.normal), double_area);
        writeSetup(taken.place, surface, t, taken.draw.material);
    }
    if (large)
        listLarge(snapped, axis, taken.place);
    for (; bricks != 0u; bricks &= bricks - 1u)
    {
        uint brick = uint(findLSB(bricks));
        ivec3 cell = (t.low >> int(kBrickLog2)) + ivec3(brick & 1u, (brick >> 1) & 1u, brick >> 2);
        cell = unpermuted(ivec3(cell.xy ^ t.mirror, cell.z), axis);
        uint info = (found.voxels.info & ~kColumnsMask) | columnsIn(found, brick);
        writeItem(place++, BrickItem(taken.place, brickEntry(brickKey(uvec3(cell), brickLevel()))),
                  ItemVoxels(info, found.voxels.layers_lo, found.voxels.layers_hi));
    }
}

// The last subgroup of a walk over chunks notes how many items are those of small triangles so far, and sizes
// voxelize/bin_large for what has been listed.
void sizeLarge(uint group_count)
{
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kChunkTriangles) && subgroupElect())
    {
        uint blocks = min(atomicOr(params.counters.data[0].large_count, 0u), params.large_capacity);
        params.counters.data[0].small_items = atomicOr(params.counters.data[0].item_count, 0u);
        params.counters.data[0].large = foldedArgs(largeGroups(blocks), kGroupsXMax);
        atomicExchange(params.counters.data[0].arrived, 0u);
    }
}

void main()
{
    ChunkTriangle taken = loadChunkTriangle();
    taken.place += params.first_setup;
    takeTriangle(taken);
    if (workgroupIndex() < chunkGroups())
        sizeLarge(chunkGroups());
}
