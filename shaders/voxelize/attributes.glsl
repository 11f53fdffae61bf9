// SPDX-License-Identifier: MIT
// The attributes of the voxels of the items, a thread an item: fragments are added to the sums of their voxels or, with
// kMixed, to those of mixed voxels, and what a single fragment gives is written at once: it is what sums would give.
// Needs GPU_ENTRY with AttributesParams.
#ifndef ZVO_SHADERS_VOXELIZE_ATTRIBUTES_GLSL
#define ZVO_SHADERS_VOXELIZE_ATTRIBUTES_GLSL

layout(local_size_x = kItemsGroup) in;

#define BRICKS_BINDING 0
#define COLOR_BINDING 15
#define LEAVES_BINDING 19
#include "voxelize/item.glsl"
#include "lib/bound.glsl"
#include "lib/brick_loads.glsl"
#include "lib/dispatch.glsl"
#include "voxelize/item_surface.glsl"
#include "voxelize/mixed_leaf.glsl"
#include "voxelize/resolve.glsl"
#include "voxelize/sums.glsl"

#ifdef BOUND
TEXELS_3(14, voxels);
#define ITEM_WORDS(I) texelFetch(texels3_voxels, int(I)).xyz
#else
#define ITEM_WORDS(I) uvec3_ConstPtr(uint64_t(params.voxels)).data[I]
#endif

Voxels loadVoxels(uint i)
{
    uvec3 words = ITEM_WORDS(kVoxelsStride * i);
    uvec2 last_layers = uvec2(0u);
    if (!kThin)
        last_layers = ITEM_WORDS(kVoxelsStride * i + 1u).yz;
    return Voxels(words.x, words.yz, last_layers);
}

void addEmission(uvec3 emission, uint voxel)
{
    uvec2 word = params.emission_words.data[voxel >> 5];
    uint bit = 1u << (voxel & 31u);
    if ((word.x & bit) != 0u)
    {
        uint rank = word.y + bitCount(word.x & (bit - 1u));
        atomicAdd(params.emission_sums.data[rank].red, emission.r >> params.sum_shift);
        atomicAdd(params.emission_sums.data[rank].green, emission.g >> params.sum_shift);
        atomicAdd(params.emission_sums.data[rank].blue, emission.b >> params.sum_shift);
    }
}

void main()
{
    uint i = params.first_item + threadIndex();
    if (i >= min(params.item_end, params.counters.data[0].covered_items))
        return;
    Voxels voxels = loadVoxels(i);
    if (!hasVoxels(voxels))
        return;
    BrickItem item = loadItem(i);
    BrickEntry entry = loadBrick(item.entry);
    Node brick = loadLeaf(nodeOf(entry));
    ivec3 corner = brickCorner(entry);
    TriangleSetup setup = loadSetup(item.triangle);
    Surface surface = surfaceOf(item.triangle, setup);
    // With kCentres, voxels of the item, whole leaves and the brick may be gone. A wide grid's bricks are below its root.
    bool has_brick = kWideKeys ? nodeOf(entry) != 0u : (entry.mask_lo | entry.mask_hi) != 0u;
    uint leaf = kBrickLeaves; // none
    Node node;
    MixedVoxels mixed;
    for (;;) // on software devices, a test in its head would cost the body once more
    {
        uvec3 voxel = takeVoxel(voxels);
        uint number = numberOf(voxel);
        uvec3 weights = weightsAt(setup, corner + ivec3(voxel));
        uvec4 color = fragmentColor(surface, weights);
        bool exists = kMaterialClass != kClassAlpha || passesAlpha(surface, color.a, uvec3(corner) + voxel);
        if (kCentres && exists && number >> 6 != leaf)
            exists = has_brick && hasChild(brick, number >> 6);
        if (exists && number >> 6 != leaf) // what is cut out may have no leaf
        {
            leaf = number >> 6;
            uint index = leafIndex(brick, leaf);
            node = loadLeaf(index);
            if (kMixed)
                mixed = loadMixedLeaf(index);
        }
        uint cell = number & 63u;
        if (kCentres && exists)
            exists = hasChild(node, cell);
        uint place = childIndex(node, cell);
        uvec3 emission = uvec3(0u);
        if (kEmits)
            emission = fragmentEmission(surface, weights);
        if (kMode == kModeEmission)
        {
            if (exists && emission != uvec3(0u))
                addEmission(emission, place);
        }
        else if (exists)
        {
            if (kEmits && emission != uvec3(0u))
                atomicOr(params.emission_words.data[place >> 5].x, 1u << (place & 31u));
            VoxelSums sums = sumsOf(color.rgb, fragmentNormal(surface, weights));
            if (!kMixed)
                addToSums(place, sums);
            else if (isMixed(mixed, cell))
                addToSums(sumsIndex(mixed, cell), sums);
            else
                STORE_MEAN(place, sums, 0u);
        }
        if (!hasVoxels(voxels))
            break;
    }
}

#endif
