#version 460
// SPDX-License-Identifier: MIT
// Sets triangles up, and makes their items, a thread a triangle. The voxels that thin coverage gives small ones are found
// here, in 32-bit integers; they have an item in each brick with one of them, mostly a single brick, and many have no
// voxel at all. With conservative coverage they have one in each brick that their box touches. Large triangles are
// listed for voxelize/bin_large, in blocks of columns of bricks.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(BinParams, VOXELIZE_BIN_CONSTANTS);
layout(local_size_x = kChunkTriangles) in;

const bool kThin = kCoverage == kCoverageThin;

#define BRICKS_BINDING 0
#define COLOR_BINDING 15
#define EDGE_INT int
#define EDGE_IVEC3 ivec3
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
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

// Blocks are those of the projection along the major axis, row by row; they grow with the triangle.
void listLarge(SnappedTriangle snapped, uint axis, uint triangle)
{
    ivec3 size = (snapped.high >> int(kBrickLog2)) - (snapped.low >> int(kBrickLog2)) + 1;
    uvec2 bricks = uvec2(permuted(size, axis).xy);
    uint log2 = kBlockBricksLog2;
    uvec2 blocks = ((bricks - 1u) >> log2) + 1u;
    for (; log2 < kBlockLog2Max && blocks.x * blocks.y > kBlocksMax; ++log2)
        blocks = (blocks + 1u) >> 1;
    uint count = blocks.x * blocks.y;
    uint first = atomicAdd(params.counters.data[0].large_count, count);
    if (first > kBlocksListMax)
        atomicMax(params.counters.data[0].blocks_exceeded, 1u); // before large_count wraps around
    for (uint block = 0u; block < count; ++block)
        if (first + block < params.large_capacity)
            params.large.data[first + block] = LargeBlock(triangle, block | (log2 << kBlockLog2Shift));
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

void writeSurface(uint place, TriangleUvs uvs, uint level, uvec2 colors[3])
{
    STORED_SURFACE(4u * place) = uvec4(uvs.u, uvs.v.x);
    STORED_SURFACE(4u * place + 1u) = uvec4(uvs.v.yz, level, colors[0].x);
    STORED_SURFACE(4u * place + 2u) = uvec4(colors[0].y, colors[1], colors[2].x);
    STORED_SURFACE(4u * place + 3u) = uvec4(colors[2].y, 0u, 0u, 0u);
}

// Of what the triangle's surface needs, all that fragments do not change. is_flat: a segment or a point.
void writeSetup(uint place, Surface surface, RasterTriangle t, bool is_flat, uint material)
{
    uint flags = t.axis | (t.mirror.x != 0 ? kSetupMirrorU : 0u) | (t.mirror.y != 0 ? kSetupMirrorV : 0u) |
                 (t.exchanged ? kSetupExchanged : 0u) | (surface.textured ? kSetupTextured : 0u) |
                 (surface.colored ? kSetupColored : 0u) | (is_flat ? kSetupFlat : 0u);
    if (surface.textured)
        flags |= surface.texture.wrap_u << kSetupWrapU | surface.texture.wrap_v << kSetupWrapV;
    if (surface.emission_textured)
        flags |= kSetupEmissionTextured | surface.emission_texture.wrap_u << kSetupEmissionWrapU |
                 surface.emission_texture.wrap_v << kSetupEmissionWrapV;
    ivec3 n0 = surface.normals[0];
    ivec3 n1 = surface.normals[1];
    ivec3 n2 = surface.normals[2];
    STORED_SETUP(4u * place) = uvec4(t.u, t.v.x);
    STORED_SETUP(4u * place + 1u) = uvec4(t.v.yz, t.w.xy);
    STORED_SETUP(4u * place + 2u) = uvec4(t.w.z, pack16(n0.x, n0.y), pack16(n0.z, n1.x), pack16(n1.y, n1.z));
    STORED_SETUP(4u * place + 3u) = uvec4(pack16(n2.x, n2.y), pack16(n2.z, 0), material, flags);
    if (surface.textured || surface.colored)
        writeSurface(kSurfacesOfTriangle * place, surface.uvs, surface.level_number, surface.colors);
    if (surface.emission_textured)
        writeSurface(kSurfacesOfTriangle * place + 1u, surface.emission_uvs, surface.emission_level_number,
                     surface.colors);
}

struct SmallVoxels
{
    Voxels voxels; // of all bricks
    uvec3 upper;   // those in the second brick along u, v, w, a bit a column
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
        bool covered = isCovered(t, cell);
        found.voxels.info |= covered ? 1u << column : 0u;
        found.voxels.layers |= layerOfColumn(column, covered ? cell.w : 0);
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

// Sets of the eight bricks that a small triangle may touch. Bit 0 of a brick's number is along u, bit 1 along v, bit 2
// along w.
const uint kAllBricks = 0xffu;
const uint kFirstAlongU = 0x55u;
const uint kFirstAlongV = 0x33u;
const uint kFirstAlongW = 0x0fu;

// The columns with a voxel in one of these bricks.
uint columnsIn(SmallVoxels found, uint brick)
{
    uvec3 others = found.upper ^ uvec3((brick & 1u) - 1u, ((brick >> 1) & 1u) - 1u, (brick >> 2) - 1u);
    return found.voxels.info & others.x & others.y & others.z & kColumnsMask;
}

// Those with voxels, a bit each.
uint bricksOf(SmallVoxels found)
{
    uint bricks = 0u;
    [[unroll]] for (uint brick = 0u; brick < 8u; ++brick)
        bricks |= columnsIn(found, brick) != 0u ? 1u << brick : 0u;
    return bricks;
}

// Those that the box of a small triangle touches.
uint bricksOf(RasterTriangle t)
{
    bvec3 two = notEqual(t.low >> int(kBrickLog2), t.high >> int(kBrickLog2));
    return (two.x ? kAllBricks : kFirstAlongU) & (two.y ? kAllBricks : kFirstAlongV) &
           (two.z ? kAllBricks : kFirstAlongW);
}

// The places of the thread's setup, if wanted, and of the first of its items: two atomics for a subgroup.
uvec2 takePlaces(bool wanted, uint item_count)
{
    const int second = 16;
    uint counts = item_count | (wanted ? 1u << second : 0u);
    uint total = subgroupAdd(counts);
    uint before = subgroupExclusiveAdd(counts);
    uvec2 first = uvec2(0u);
    if (subgroupElect() && total != 0u)
    {
        first.x = atomicAdd(params.counters.data[0].setup_count, total >> second);
        first.y = addItems(bitfieldExtract(total, 0, second));
    }
    return subgroupBroadcastFirst(first) + uvec2(before >> second, bitfieldExtract(before, 0, second));
}

void takeTriangle(ChunkTriangle taken)
{
    uvec3 vertices = loadTriangle(taken.draw.first_triangle + taken.triangle);
    SnappedTriangle snapped = snapTriangle(taken.draw, vertices, kThin);
    if (taken.exists)
        countDropped(snapped.fate);
    bool kept = taken.exists && snapped.fate == kKept && all(lessThanEqual(snapped.low, snapped.high));
    bool small = kept && isSmall(snapped);
    uint axis = majorAxis(snapped.normal, snapped.low, snapped.high);
    RasterTriangle t = setupTriangle(snapped.v0, snapped.v1, snapped.v2, snapped.normal, axis, snapped.low,
                                     snapped.high, gridResolution());
    SmallVoxels found = coverSmall(t, kThin && small);
    uint bricks = kThin ? bricksOf(found) : (small ? bricksOf(t) : 0u);
    bool large = kept && !small;
    bool wanted = large || (kKeepsSetups && bricks != 0u);
    uvec2 places = takePlaces(wanted, bitCount(bricks));
    uint setup = places.x;
    uint place = places.y;
    if (wanted && setup < params.setup_capacity)
    {
        float double_area = float(abs(permuted(snapped.normal, axis).z)); // in the projection along the major axis
        Surface surface = loadSurface(taken.draw, vertices, vec3(snapped.normal), double_area);
        writeSetup(setup, surface, t, snapped.normal == i64vec3(0), taken.draw.material);
    }
    if (large)
        listLarge(snapped, axis, setup);
    if (bricks == 0u)
        return;
    for (;;) // on software devices, a test in its head would cost the body once more
    {
        uint brick = uint(findLSB(bricks));
        ivec3 cell = (t.low >> int(kBrickLog2)) + ivec3(brick & 1u, (brick >> 1) & 1u, brick >> 2);
        cell = unpermuted(ivec3(cell.xy ^ t.mirror, cell.z), axis);
        uint entry = brickEntry(brickKey(uvec3(cell), brickLevel()));
        uint info = kThin ? (found.voxels.info & ~kColumnsMask) | columnsIn(found, brick) : kWholeBox;
        writeItem(place++, BrickItem(setup, entry), ItemVoxels(info, found.voxels.layers.x, found.voxels.layers.y));
        bricks &= bricks - 1u;
        if (bricks == 0u)
            break;
    }
}

// The last subgroup of a walk over chunks notes how many items there are so far, if their voxels are known, and sizes
// voxelize/bin_large for what has been listed.
void sizeLarge(uint group_count)
{
    uint here = arrivingThreads();
    uint before = subgroupElect() ? atomicAdd(params.counters.data[0].arrived, here) : 0u;
    if (areLastThreads(before, here, group_count * kChunkTriangles) && subgroupElect())
    {
        uint blocks = min(atomicOr(params.counters.data[0].large_count, 0u), params.large_capacity);
        if (kThin) // else the voxels of all items are still to be found
            params.counters.data[0].known_items = atomicOr(params.counters.data[0].item_count, 0u);
        params.counters.data[0].large = foldedArgs(largeGroups(blocks), kGroupsXMax);
        atomicExchange(params.counters.data[0].arrived, 0u);
    }
}

void main()
{
    ChunkTriangle taken = loadChunkTriangle();
    takeTriangle(taken);
    if (workgroupIndex() < chunkGroups())
        sizeLarge(chunkGroups());
}
