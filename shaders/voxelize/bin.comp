#version 460
// SPDX-License-Identifier: MIT
// Sets triangles up, and makes their items, a thread a triangle. Small ones have one in each brick that their box
// touches, mostly a single one. Large ones are listed for voxelize/bin_large, in blocks of columns of bricks.
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
#define EDGE_INT int64_t
#define EDGE_IVEC3 i64vec3
#define EDGE_WIDE
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/arrivals.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
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

// Returns whether the triangle is small and has voxels, and its box of voxels in x, y, z.
bool setUp(ChunkTriangle taken, out ivec3 low, out ivec3 high)
{
    uvec3 vertices = loadTriangle(taken.draw.first_triangle + taken.triangle);
    SnappedTriangle snapped = snapTriangle(taken.draw, vertices, true);
    low = snapped.low;
    high = snapped.high;
    bool small = false;
    if (taken.exists)
        countDropped(snapped.fate);
    if (taken.exists && snapped.fate == kKept && all(lessThanEqual(low, high)))
    {
        small = isSmall(snapped);
        uint axis = majorAxis(snapped.normal, low, high);
        RasterTriangle t = setupTriangle(snapped.v0, snapped.v1, snapped.v2, snapped.normal, axis, low, high,
                                         gridResolution());
        Surface surface = loadSurface(taken.draw, vertices, vec3(snapped.normal), float(t.n_w));
        writeSetup(taken.place, surface, t, taken.draw.material);
        if (!small)
            listLarge(snapped, axis, taken.place);
    }
    return small;
}

void takeTriangle(ChunkTriangle taken)
{
    ivec3 low;
    ivec3 high;
    bool small = setUp(taken, low, high);
    low >>= int(kBrickLog2);
    high >>= int(kBrickLog2);
    uvec3 size = small ? uvec3(high - low + 1) : uvec3(0u);
    uint count = size.x * size.y * size.z;
    uint total = subgroupAdd(count);
    uint place = subgroupExclusiveAdd(count);
    uint first = 0u;
    if (subgroupElect() && total != 0u)
        first = addItems(total);
    place += subgroupBroadcastFirst(first);
    ivec3 brick = low;
    for (uint left = count; left > 0u; --left)
    {
        writeItem(place++, taken.place, kWholeBox, brickEntry(brickKey(uvec3(brick), brickLevel())));
        bool x_ends = brick.x == high.x;
        bool y_ends = x_ends && brick.y == high.y;
        brick = ivec3(x_ends ? low.x : brick.x + 1, y_ends ? low.y : (x_ends ? brick.y + 1 : brick.y),
                      y_ends ? brick.z + 1 : brick.z);
    }
}

// The last subgroup of a walk over chunks sizes voxelize/bin_large for what has been listed so far.
void sizeLarge(uint group_count)
{
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kChunkTriangles) && subgroupElect())
    {
        uint blocks = min(atomicOr(params.counters.data[0].large_count, 0u), params.large_capacity);
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
