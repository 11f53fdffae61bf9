#version 460
// SPDX-License-Identifier: MIT
// The attributes of a brick's voxels, and its leaves' nodes: a workgroup a unit, mostly a brick. A thread takes an
// item, and adds its fragments to the sums of their voxels. These are in shared memory: a brick with more than
// kSumVoxels voxels is taken in several walks over its items. The sums of a brick with several units meet in memory,
// where the last unit that arrives finds all of them; nobody waits.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(AttributesParams, VOXELIZE_ATTRIBUTES_CONSTANTS);
layout(local_size_x_id = 1) in;

const bool kEmits = false;
const uint kMode = kModeAttributes;

#define COLOR_BINDING 15
#define SCAN_GROUP kLocalSizeX
#include "voxelize/item.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/scan.glsl"
#include "voxelize/resolve.glsl"
#include "voxelize/shading.glsl"

const uint kSumWords = 7u;

shared uint s_masks[kBrickWords];
shared uint s_ranks[kBrickWords]; // voxels before a word
shared uint s_sums[kSumWords * kSumVoxels];
shared bool s_is_last; // of the brick's units

#ifdef BOUND
TEXELS_3(14, voxels);

ItemVoxels loadVoxels(uint i)
{
    uvec3 words = texelFetch(texels3_voxels, int(i)).xyz;
    return ItemVoxels(words.x, words.y, words.z);
}
#else
ItemVoxels loadVoxels(uint i)
{
    return params.voxels.data[i];
}
#endif

void addFragment(uint rank, uvec3 color, ivec3 normal)
{
    color >>= params.sum_shift;
    uvec3 biased = uvec3(normal >> params.sum_shift) + normalBias(params.sum_shift);
    [[unroll]] for (uint axis = 0u; axis < 3u; ++axis)
    {
        atomicAdd(s_sums[axis * kSumVoxels + rank], color[axis]);
        atomicAdd(s_sums[(3u + axis) * kSumVoxels + rank], biased[axis]);
    }
    atomicAdd(s_sums[6u * kSumVoxels + rank], 1u);
}

VoxelSums sharedSums(uint rank)
{
    return VoxelSums(s_sums[rank], s_sums[kSumVoxels + rank], s_sums[2u * kSumVoxels + rank],
                     s_sums[3u * kSumVoxels + rank], s_sums[4u * kSumVoxels + rank], s_sums[5u * kSumVoxels + rank],
                     s_sums[6u * kSumVoxels + rank], 0u);
}

void loadMasks(uint brick)
{
    uint lane = gl_LocalInvocationIndex;
    for (uint i = lane; i < kBrickWords; i += kLocalSizeX)
        s_masks[i] = params.masks.data[brick * kBrickWords + i];
    barrier();
    const uint words = kBrickWords / kLocalSizeX;
    uint count = 0u;
    for (uint i = 0u; i < words; ++i)
        count += bitCount(s_masks[lane * words + i]);
    uint total;
    uint before = workgroupExclusiveAdd(count, total);
    for (uint i = 0u; i < words; ++i)
    {
        s_ranks[lane * words + i] = before;
        before += bitCount(s_masks[lane * words + i]);
    }
}

void writeLeaves(uint entry, uint first_voxel)
{
    Node node = params.nodes.data[nodeOf(params.bricks.data[entry])];
    for (uint leaf = gl_LocalInvocationIndex; leaf < kBrickLeaves; leaf += kLocalSizeX)
    {
        uint mask = leaf < 32u ? node.mask_lo : node.mask_hi;
        uint below = (1u << (leaf & 31u)) - 1u;
        uint base = leaf < 32u ? node.base_lo : node.base_hi;
        if (((mask >> (leaf & 31u)) & 1u) != 0u)
            params.nodes.data[base + bitCount(mask & below)] =
                Node(s_masks[2u * leaf], first_voxel + s_ranks[2u * leaf], s_masks[2u * leaf + 1u],
                     first_voxel + s_ranks[2u * leaf + 1u]);
    }
}

void takeItem(uint i, uint first_rank, ivec3 corner)
{
    ItemVoxels voxels = loadVoxels(i);
    ItemTriangle item = loadTriangle(loadItem(i), corner);
    Surface surface = loadSurface(item.draw, item.vertices, vec3(item.normal), float(item.t.n_w));
    for (; hasVoxels(voxels);)
    {
        uvec3 voxel = takeVoxel(voxels);
        uint number = numberOf(voxel);
        uint below = (1u << (number & 31u)) - 1u;
        uint rank = s_ranks[number >> 5] + bitCount(s_masks[number >> 5] & below) - first_rank;
        if (rank < kSumVoxels)
        {
            uvec3 weights = fixedWeights(cornersAt(item.t, uvec3(corner) + voxel), item.t.n_w != 0l);
            addFragment(rank, fragmentColor(surface, weights).rgb, fragmentNormal(surface, weights));
        }
    }
}

void writeVoxel(uint voxel, VoxelSums sums)
{
    if ((sums.fragments >> params.sum_shift) > kFragmentsMax)
        atomicMax(params.max_fragments.data[0], sums.fragments);
    STORE_MEAN(voxel, sums, 0u);
}

// Adds to a word of the sums of a voxel in memory. Returns what it was before.
uint addToMemory(uint sums, uint word, uint value)
{
    return atomicAdd(uint_Ptr(uint64_t(params.sums) + uint64_t(sums) * kVoxelSumsBytes).data[word], value);
}

VoxelSums memorySums(uint sums)
{
    return VoxelSums(addToMemory(sums, 0u, 0u), addToMemory(sums, 1u, 0u), addToMemory(sums, 2u, 0u),
                     addToMemory(sums, 3u, 0u), addToMemory(sums, 4u, 0u), addToMemory(sums, 5u, 0u),
                     addToMemory(sums, 6u, 0u), 0u);
}

// Adds the sums of voxels from first_rank on to those of the brick's other units.
void shareSums(BrickRange range, uint first_rank, uint count)
{
    for (uint i = gl_LocalInvocationIndex; i < count; i += kLocalSizeX)
        if (s_sums[6u * kSumVoxels + i] != 0u)
            for (uint word = 0u; word < kSumWords; ++word)
                addToMemory(range.first_sums + first_rank + i, word, s_sums[word * kSumVoxels + i]);
}

// Writes the voxels of a brick with several units, if this is the last one.
void writeSharedVoxels(uint brick, BrickRange range)
{
    memoryBarrierBuffer();
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        s_is_last = (atomicAdd(params.ranges.data[brick].arrived, 1u) + 1u) % range.units == 0u;
    memoryBarrierBuffer();
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < (s_is_last ? range.voxels : 0u); i += kLocalSizeX)
        writeVoxel(range.first_voxel + i, memorySums(range.first_sums + i));
}

void main()
{
    if (workgroupIndex() >= params.unit_count)
        return;
    uint lane = gl_LocalInvocationIndex;
    BrickUnit unit = params.units.data[workgroupIndex()];
    BrickRange range = params.ranges.data[unit.brick];
    if (range.voxels == 0u)
        return;
    ivec3 corner = brickCorner(params.bricks.data[range.entry]);
    loadMasks(unit.brick);
    barrier();
    if (unit.first == range.first)
        writeLeaves(range.entry, range.first_voxel);
    for (uint first_rank = 0u; first_rank < range.voxels; first_rank += kSumVoxels)
    {
        uint count = min(range.voxels - first_rank, kSumVoxels);
        for (uint i = lane; i < count; i += kLocalSizeX)
            [[unroll]] for (uint word = 0u; word < kSumWords; ++word)
                s_sums[word * kSumVoxels + i] = 0u;
        barrier();
        for (uint i = lane; i < unit.count; i += kLocalSizeX)
            takeItem(unit.first + i, first_rank, corner);
        barrier();
        if (range.units > 1u)
            shareSums(range, first_rank, count);
        else
            for (uint i = lane; i < count; i += kLocalSizeX)
                writeVoxel(range.first_voxel + first_rank + i, sharedSums(i));
        barrier();
    }
    if (range.units > 1u)
        writeSharedVoxels(unit.brick, range);
}
