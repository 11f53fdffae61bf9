#version 460
// SPDX-License-Identifier: MIT
// The voxels of the items of large triangles, and the masks of the leaves of all items' bricks, a thread an item.
// Neighbours are mostly items of one brick, whose masks stay in a cache.
#extension GL_GOOGLE_include_directive : require
#include "voxelize/bricks.h"

GPU_ENTRY(CoverParams, VOXELIZE_COVER_CONSTANTS);
layout(local_size_x = kItemsGroup) in;

const uint kMode = kModeCoverage;

#define BRICKS_BINDING 0
#define COLOR_BINDING 15
#include "voxelize/item.glsl"
#include "lib/bound.glsl"
#include "lib/brick_loads.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/crossing.glsl"
#include "voxelize/item_surface.glsl"

#ifdef BOUND
STORAGE(2, uint, masks);
STORAGE(3, uint, crossings);
#define CROSSING_WORD(I) storage_crossings.data[I]
STORAGE(14, ItemVoxels, voxels);
#define MASK_WORD(I) storage_masks.data[I]
#define ITEM_VOXELS(I) storage_voxels.data[I]
#else
#define CROSSING_WORD(I) params.crossings.data[I]
#define MASK_WORD(I) params.masks.data[I]
#define ITEM_VOXELS(I) params.voxels.data[I]
#endif

const uint kMaskWords = kMixed ? 2u * kLeafMaskWords : kLeafMaskWords; // of a brick

Voxels knownVoxels(uint i)
{
    ItemVoxels voxels = ITEM_VOXELS(kVoxelsStride * i);
    return Voxels(voxels.info, uvec2(voxels.layers_lo, voxels.layers_hi), uvec2(0u));
}

void keepVoxels(uint i, Voxels voxels)
{
    ITEM_VOXELS(kVoxelsStride * i) = ItemVoxels(voxels.info, voxels.layers.x, voxels.layers.y);
    if (!kThin)
        ITEM_VOXELS(kVoxelsStride * i + 1u) = ItemVoxels(0u, voxels.last_layers.x, voxels.last_layers.y);
}

// Sets bits of a word of a brick's masks; those that were set already are those of mixed voxels.
void setVoxels(uint word, uint bits)
{
    uint again = atomicOr(MASK_WORD(word), bits) & bits;
    if (kMixed && again != 0u)
        atomicOr(MASK_WORD(word + kLeafMaskWords), again);
}

// Sets the voxels of an item. tests: alpha decides which exist.
void setItem(BrickItem item, BrickEntry entry, Voxels voxels, bool tests)
{
    if (!hasVoxels(voxels))
        return;
    ivec3 brick = brickCorner(entry);
    TriangleSetup setup;
    Surface surface;
    if (tests)
    {
        setup = loadSetup(item.triangle);
        surface = surfaceOf(item.triangle, setup);
    }
    // Voxels of an item mostly share a word with the one before: their bits take one atomic.
    uint first_word = entry.mask_lo * kMaskWords;
    uint word = 0u;
    uint bits = 0u;
    for (;;) // on software devices, a test in its head would cost the body once more
    {
        uvec3 voxel = takeVoxel(voxels);
        uint number = numberOf(voxel);
        bool exists = true;
        if (tests)
            exists = passesAlpha(surface, fragmentColor(surface, weightsAt(setup, brick + ivec3(voxel))).a,
                                 uvec3(brick) + voxel);
        if (number >> 5 != word && bits != 0u)
        {
            setVoxels(first_word + word, bits);
            bits = 0u;
        }
        word = number >> 5;
        bits |= exists ? 1u << (number & 31u) : 0u;
        if (!hasVoxels(voxels))
        {
            if (bits != 0u)
                setVoxels(first_word + word, bits);
            break;
        }
    }
}

// Adds a crossing to the counts of a voxel: digits are added from the lowest plane up. first_word: of the planes of the
// line's axis and way.
void addCrossing(uint first_word, uint number)
{
    uint word = first_word + (number >> 5);
    uint carry = 1u << (number & 31u);
    for (uint plane = 0u; plane < kFillPlanes && carry != 0u; ++plane)
        carry &= atomicXor(CROSSING_WORD(word + plane * kLeafMaskWords), carry);
    if (carry != 0u)
        atomicMax(params.counters.data[0].crossings_exceeded, 1u);
}

// Counts the crossings in the voxels of an item. Planes of lines along z and x have the voxels turned: their lines stand
// there as those along y do.
void addCrossings(BrickItem item, BrickEntry entry, Voxels voxels)
{
    ivec3 brick = brickCorner(entry);
    TriangleSetup setup = loadSetup(item.triangle);
    uint first_word = entry.mask_lo * fillWords(kFillPlanes, kRobust, kCentres);
    while (hasVoxels(voxels))
    {
        uvec3 voxel = takeVoxel(voxels);
        uvec3 place = voxel;
        [[unroll]] for (uint line = 0u; line < (kRobust ? kFillAxes : 1u); ++line)
        {
            bool above;
            int sign = crossing(setup, brick + ivec3(voxel), line, above);
            uint planes = (2u * line + (sign < 0 ? 1u : 0u)) * kFillPlanes;
            if (sign != 0)
                addCrossing(first_word + planes * kLeafMaskWords, numberOf(place));
            if (kCentres && sign != 0 && above)
                addCrossing(first_word + (planes + 2u * kFillPlanes) * kLeafMaskWords, numberOf(place));
            place = place.yzx;
        }
    }
}

void main()
{
    uint known_items = params.counters.data[0].known_items;
    uint end = params.counters.data[0].covered_items;
    uint i = threadIndex() + (kKnown ? 0u : known_items);
    if (i >= (kKnown ? min(known_items, end) : end))
        return;
    BrickItem item = loadItem(i);
    BrickEntry entry = loadBrick(item.entry);
    Voxels voxels = knownVoxels(i);
    if (!kKnown)
    {
        voxels = coverColumns(itemTriangle(voxels.info, loadSetup(item.triangle), brickCorner(entry)));
        keepVoxels(i, voxels);
    }
    bool tests = false;
    if (kMaterialClass == kClassAlpha)
        tests = loadMaterial(loadSetup(item.triangle).material).alpha_mode != kAlphaOpaque;
    if (kFillPlanes != 0u && !tests) // what alpha cuts encloses nothing
        addCrossings(item, entry, voxels);
    Voxels none = voxels;
    none.info &= ~kColumnsMask;
    setItem(item, entry, tests ? none : voxels, false);
    if (kMaterialClass == kClassAlpha)
        setItem(item, entry, tests ? voxels : none, true);
}
