// SPDX-License-Identifier: MIT
// Uses of a fragment, chosen by kMode: it sets a bit in the brick table, or is added to the voxel's sums.
//
// With kMixed, coverage tells voxels that several fragments share from the others, and sums are kept of those alone:
// the attribute of a voxel with one fragment is written at once. It is the same as the one that sums would give.
//
// Needs EDGE_INT and EDGE_IVEC3, kWideKeys, the constants of voxelize/constants.glsl, and RasterParams.
#ifndef ZVO_SHADERS_VOXELIZE_FRAGMENT_GLSL
#define ZVO_SHADERS_VOXELIZE_FRAGMENT_GLSL

#include "lib/brick_keys.glsl"
#include "lib/brick_loads.glsl"
#include "lib/bricks.glsl"
#include "lib/morton.glsl"
#include "voxelize/raster.glsl"
#include "voxelize/resolve.glsl"
#include "voxelize/surface.glsl"
#include "voxelize/sums.glsl"
#include "voxelize/voxelize.h"
#include "voxelize/window.glsl"

// The leaf of this thread's last fragment, which neighbours mostly share.
struct BrickCursor
{
    uvec2 key;
    uint entry;
    uint base;         // first voxel of the leaf; not in coverage mode
    uvec2 masks;       // in coverage mode a hint: other threads may have set more voxels
    MixedVoxels mixed; // in coverage mode a hint as well
};

// Level of the leaves among the nodes' levels.
uint leafLevel()
{
    return uint(gridDepth() - 1) / 2u;
}

BrickCursor noBrick()
{
    return BrickCursor(uvec2(0u), kNoEntry, 0u, uvec2(0u), MixedVoxels(0u, 0u, 0u, 0u));
}

void moveToBrick(uvec2 key, inout BrickCursor cursor)
{
    if (!isSameKey(key, cursor.key))
    {
        cursor.key = key;
        BrickEntry leaf;
        if (kMode == kModeCoverage)
        {
            bool claimed;
            cursor.entry = brickFindOrInsert(key, claimed, leaf);
            if (cursor.entry == kNoEntry)
                atomicAdd(params.counters.data[0].overflow_count, 1u);
        }
        else
        {
            cursor.entry = brickFind(key, leaf);
        }
        cursor.base = leaf.base;
        cursor.masks = uvec2(leaf.mask_lo, leaf.mask_hi);
        if (kMixed && cursor.entry != kNoEntry)
            cursor.mixed = loadMixed(params.brick_mask + 1u, cursor.entry);
        if (kMode != kModeCoverage && kWideKeys && cursor.entry != kNoEntry)
        {
            Node node = params.nodes.data[nodeOf(leaf)];
            cursor.base = node.base_lo;
            cursor.masks = uvec2(node.mask_lo, node.mask_hi);
        }
    }
}

// Sets voxels in word `word` of a leaf's masks, and notes those that were set before.
void setVoxels(BrickCursor cursor, uint word, uint bits)
{
    uint known = word == 0u ? cursor.masks.x : cursor.masks.y;
    uint again = bits & known;
    if ((bits & ~known) != 0u)
        again |= atomicOr(BRICK_WORD(cursor.entry, kMaskWord + word), bits) & bits;
    uint known_mixed = word == 0u ? cursor.mixed.mask_lo : cursor.mixed.mask_hi;
    if (kMixed && (again & ~known_mixed) != 0u)
        atomicOr(BRICK_WORD(params.brick_mask + 1u + cursor.entry, word), again);
}

// The number of the voxels of a leaf's masks before a cell.
uint rankInMasks(uvec2 masks, uint cell)
{
    uint below = (1u << (cell & 31u)) - 1u;
    return cell < 32u ? bitCount(masks.x & below) : bitCount(masks.x) + bitCount(masks.y & below);
}

// The attributes of a fragment that kMode needs.
struct Fragment
{
    uvec3 weights;
    uvec3 color;
    uvec3 emission;
    bool exists;
};

void addAttributes(Surface surface, Fragment fragment, BrickCursor cursor, uint cell)
{
    uint voxel = cursor.base + rankInMasks(cursor.masks, cell);
    VoxelSums sums = sumsOf(fragment.color, fragmentNormal(surface, fragment.weights));
    if (kEmits && any(notEqual(fragment.emission, uvec3(0u))))
        atomicOr(params.emission_words.data[voxel >> 5].x, 1u << (voxel & 31u));
    if (kMixed)
    {
        uvec2 mixed = uvec2(cursor.mixed.mask_lo, cursor.mixed.mask_hi);
        if (((cell < 32u ? mixed.x : mixed.y) >> (cell & 31u) & 1u) != 0u)
            addToSums(cursor.mixed.first + rankInMasks(mixed, cell), sums);
        else
            STORE_MEAN(voxel, sums, 0u);
        return;
    }
    addToSums(voxel, sums);
}

void addEmission(uvec3 emission, uint voxel)
{
    uvec2 word = params.emission_words.data[voxel >> 5];
    uint bit = 1u << (voxel & 31u);
    if (any(notEqual(emission, uvec3(0u))) && (word.x & bit) != 0u)
    {
        uint rank = word.y + bitCount(word.x & (bit - 1u));
        atomicAdd(params.emission_sums.data[rank].red, emission.r >> params.sum_shift);
        atomicAdd(params.emission_sums.data[rank].green, emission.g >> params.sum_shift);
        atomicAdd(params.emission_sums.data[rank].blue, emission.b >> params.sum_shift);
    }
}

Fragment shadeFragment(RasterTriangle triangle, Surface surface, EDGE_IVEC3 corners, uvec3 voxel)
{
    Fragment fragment = Fragment(uvec3(0u), uvec3(0u), uvec3(0u), true);
    if (kMode != kModeCoverage || kMaterialClass == kClassAlpha)
    {
        fragment.weights = fixedWeights(corners, triangle.n_w != 0);
        uvec4 color = fragmentColor(surface, fragment.weights);
        fragment.color = color.rgb;
        if (kMaterialClass == kClassAlpha)
            fragment.exists = passesAlpha(surface, color.a, voxel);
        if (kMode == kModeEmission || (kMode == kModeAttributes && kEmits))
            fragment.emission = fragmentEmission(surface, fragment.weights);
    }
    return fragment;
}

uvec2 leafKey(uvec3 voxel)
{
    return brickKey(voxel >> 2, leafLevel());
}

// Adds a fragment in the leaf of cursor to the voxel's sums.
void addFragment(Surface surface, Fragment fragment, BrickCursor cursor, uint cell)
{
    if (kMode == kModeAttributes)
        addAttributes(surface, fragment, cursor, cell);
    if (kMode == kModeEmission)
        addEmission(fragment.emission, cursor.base + rankInMasks(cursor.masks, cell));
}

// Called for each voxel that the triangle covers.
void emitFragment(RasterTriangle triangle, Surface surface, EDGE_IVEC3 corners, uvec3 voxel, inout BrickCursor cursor)
{
    Fragment fragment = shadeFragment(triangle, surface, corners, voxel);
    if (fragment.exists)
    {
        moveToBrick(leafKey(voxel), cursor);
        if (cursor.entry != kNoEntry)
        {
            uint cell = cellInBlock(voxel);
            if (kMode != kModeCoverage)
                addFragment(surface, fragment, cursor, cell);
            else
                setVoxels(cursor, cell >> 5, 1u << (cell & 31u));
        }
    }
}

#endif
