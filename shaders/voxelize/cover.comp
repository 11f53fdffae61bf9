#version 460
// SPDX-License-Identifier: MIT
// The voxels of the items of large triangles, and the masks of the leaves of all items' bricks, a thread an item.
// Neighbours are mostly items of one brick, whose masks stay in a cache.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(CoverParams, VOXELIZE_COVER_CONSTANTS);
layout(local_size_x = kItemsGroup) in;

const bool kEmits = false;
const uint kMode = kModeCoverage;

#define BRICKS_BINDING 0
#define COLOR_BINDING 15
#include "voxelize/item.glsl"
#include "lib/bound.glsl"
#include "lib/brick_loads.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/item_surface.glsl"

#ifdef BOUND
STORAGE(2, uint, masks);
STORAGE(14, ItemVoxels, voxels);
#define MASK_WORD(I) storage_masks.data[I]
#define ITEM_VOXELS(I) storage_voxels.data[I]
#else
#define MASK_WORD(I) params.masks.data[I]
#define ITEM_VOXELS(I) params.voxels.data[I]
#endif

const uint kMaskWords = kMixed ? 2u * kLeafMaskWords : kLeafMaskWords; // of a brick

// Takes away what cut-outs leave out. brick: its first voxel.
void cutOut(BrickItem item, TriangleSetup setup, ivec3 brick, inout ItemVoxels voxels)
{
    Surface surface = surfaceOf(item.triangle, setup);
    if (surface.alpha_mode == kAlphaOpaque)
        return;
    uint existing = voxels.info;
    for (ItemVoxels left = voxels; hasVoxels(left);)
    {
        uint before = left.info;
        uvec3 voxel = uvec3(brick) + takeVoxel(left);
        uint alpha = fragmentColor(surface, fixedWeights(cornersAt(setup, ivec3(voxel)), true)).a;
        existing &= passesAlpha(surface, alpha, voxel) ? ~0u : ~(before ^ left.info);
    }
    voxels.info = existing;
}

// Sets bits of a word of a brick's masks; those that were set already are those of mixed voxels.
void setVoxels(uint word, uint bits)
{
    uint again = atomicOr(MASK_WORD(word), bits) & bits;
    if (kMixed && again != 0u)
        atomicOr(MASK_WORD(word + kLeafMaskWords), again);
}

void main()
{
    uint small_items = params.counters.data[0].small_items;
    uint end = params.counters.data[0].covered_items;
    uint i = threadIndex() + (kSmall ? 0u : small_items);
    if (i >= (kSmall ? min(small_items, end) : end))
        return;
    BrickItem item = loadItem(i);
    BrickEntry entry = loadBrick(item.entry);
    ItemVoxels voxels = ITEM_VOXELS(i);
    if (!kSmall || kMaterialClass == kClassAlpha)
    {
        TriangleSetup setup = loadSetup(item.triangle);
        ivec3 brick = brickCorner(entry);
        if (!kSmall)
            voxels = coverColumns(tileTriangle(voxels.info, setup, brick));
        if (kMaterialClass == kClassAlpha)
            cutOut(item, setup, brick, voxels);
        ITEM_VOXELS(i) = voxels;
    }
    // Voxels of an item mostly share a word with the one before: their bits take one atomic.
    uint first_word = entry.mask_lo * kMaskWords;
    uint word = 0u;
    uint bits = 0u;
    for (ItemVoxels left = voxels; hasVoxels(left);)
    {
        uint number = numberOf(takeVoxel(left));
        if (number >> 5 != word && bits != 0u)
        {
            setVoxels(first_word + word, bits);
            bits = 0u;
        }
        word = number >> 5;
        bits |= 1u << (number & 31u);
    }
    if (bits != 0u)
        setVoxels(first_word + word, bits);
}
