#version 460
// SPDX-License-Identifier: MIT
// The masks of a brick's leaves, a workgroup a unit: mostly a brick. Of a brick with several units the last one that
// arrives writes what is known of all; nobody waits.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(CoverParams, VOXELIZE_COVER_CONSTANTS);
layout(local_size_x_id = 1) in;

const bool kEmits = false;
const uint kMode = kModeCoverage;

#define COLOR_BINDING 15
#include "voxelize/item.glsl"
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/shading.glsl"

shared uint s_masks[kBrickWords];
shared uint s_leaves[2];
shared uint s_voxels;
shared bool s_is_last; // of the brick's units

void coverItem(uint i, ivec3 corner)
{
    ItemTriangle item = loadTriangle(loadItem(i), corner);
    ItemVoxels voxels = coverItem(item.t);
    Surface surface;
    if (kMaterialClass == kClassAlpha)
        surface = loadSurface(item.draw, item.vertices, vec3(item.normal), float(item.t.n_w));
    uint existing = voxels.info;
    for (ItemVoxels left = voxels; hasVoxels(left);)
    {
        uint before = left.info;
        uvec3 voxel = takeVoxel(left);
        bool exists = true;
        if (kMaterialClass == kClassAlpha)
        {
            uvec3 weights = fixedWeights(cornersAt(item.t, uvec3(corner) + voxel), item.t.n_w != 0l);
            exists = passesAlpha(surface, fragmentColor(surface, weights).a, uvec3(corner) + voxel);
            existing &= exists ? ~0u : ~(before ^ left.info);
        }
        uint number = numberOf(voxel);
        if (exists)
            atomicOr(s_masks[number >> 5], 1u << (number & 31u));
    }
    voxels.info = existing;
    params.voxels.data[i] = voxels;
}

// Adds the masks of a unit to those of the other units, and finds out whether it is the last one, which has all.
void shareMasks(uint brick, uint units)
{
    uint lane = gl_LocalInvocationIndex;
    for (uint i = lane; i < kBrickWords; i += kLocalSizeX)
        if (s_masks[i] != 0u)
            atomicOr(params.masks.data[brick * kBrickWords + i], s_masks[i]);
    memoryBarrierBuffer();
    barrier();
    if (lane == 0u)
        s_is_last = atomicAdd(params.ranges.data[brick].arrived, 1u) + 1u == units;
    memoryBarrierBuffer();
    barrier();
    for (uint i = lane; i < (s_is_last ? kBrickWords : 0u); i += kLocalSizeX)
        s_masks[i] = atomicOr(params.masks.data[brick * kBrickWords + i], 0u);
    barrier();
}

// Writes what is known of the brick by its masks, and these, if they are not in memory already.
void writeBrick(uint brick, bool writes_masks)
{
    uint lane = gl_LocalInvocationIndex;
    uint voxel_count = 0u;
    uvec2 leaves = uvec2(0u);
    for (uint leaf = lane; leaf < kBrickLeaves; leaf += kLocalSizeX)
    {
        uvec2 masks = uvec2(s_masks[2u * leaf], s_masks[2u * leaf + 1u]);
        if (writes_masks)
            uvec2_Ptr(uint64_t(params.masks)).data[brick * kBrickLeaves + leaf] = masks;
        voxel_count += bitCount(masks.x) + bitCount(masks.y);
        uint bit = (masks.x | masks.y) != 0u ? 1u << (leaf & 31u) : 0u;
        leaves |= leaf < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
    }
    if (voxel_count != 0u)
        atomicAdd(s_voxels, voxel_count);
    if (leaves.x != 0u)
        atomicOr(s_leaves[0], leaves.x);
    if (leaves.y != 0u)
        atomicOr(s_leaves[1], leaves.y);
    barrier();
    if (lane == 0u)
    {
        uint entry = params.ranges.data[brick].entry;
        params.bricks.data[entry].mask_lo = s_leaves[0];
        params.bricks.data[entry].mask_hi = s_leaves[1];
        params.ranges.data[brick].voxels = s_voxels;
    }
}

void main()
{
    if (workgroupIndex() >= params.counters.data[0].covered_units)
        return;
    uint lane = gl_LocalInvocationIndex;
    BrickUnit unit = params.units.data[workgroupIndex()];
    ivec3 corner = brickCorner(params.bricks.data[params.ranges.data[unit.brick].entry]);
    for (uint i = lane; i < kBrickWords; i += kLocalSizeX)
        s_masks[i] = 0u;
    if (lane < 2u)
        s_leaves[lane] = 0u;
    if (lane == 2u)
        s_voxels = 0u;
    if (lane == 3u)
        s_is_last = true;
    barrier();
    for (uint i = lane; i < unit.count; i += kLocalSizeX)
        coverItem(unit.first + i, corner);
    barrier();
    if (unit.units > 1u)
        shareMasks(unit.brick, unit.units);
    if (s_is_last)
        writeBrick(unit.brick, unit.units == 1u);
}
