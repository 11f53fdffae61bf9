// SPDX-License-Identifier: MIT
// The attributes of the voxels of the items, a thread an item: fragments are added to the sums of their voxels or, with
// kMixed, to those of mixed voxels, and what a single fragment gives is written at once.
// Needs GPU_ENTRY with AttributesParams.
#ifndef ZVO_SHADERS_VOXELIZE_ATTRIBUTES_GLSL
#define ZVO_SHADERS_VOXELIZE_ATTRIBUTES_GLSL

layout(local_size_x = kItemsGroup) in;

const bool kEmits = false;
const uint kMode = kModeAttributes;

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

void main()
{
    uint i = threadIndex();
    if (i >= params.item_count)
        return;
    ItemVoxels voxels = loadVoxels(i);
    if (!hasVoxels(voxels))
        return;
    BrickItem item = loadItem(i);
    BrickEntry entry = loadBrick(item.entry);
    Node brick = loadLeaf(nodeOf(entry));
    ivec3 corner = brickCorner(entry);
    TriangleSetup setup = loadSetup(item.triangle);
    Surface surface = surfaceOf(item.triangle, setup);
    uint leaf = kBrickLeaves; // none
    Node node;
    MixedVoxels mixed;
    for (; hasVoxels(voxels);)
    {
        uvec3 voxel = takeVoxel(voxels);
        uint number = numberOf(voxel);
        if (number >> 6 != leaf)
        {
            leaf = number >> 6;
            uint index = childIndex(brick, leaf);
            node = loadLeaf(index);
            if (kMixed)
                mixed = loadMixedLeaf(index);
        }
        uint cell = number & 63u;
        uvec3 weights = fixedWeights(cornersAt(setup, corner + ivec3(voxel)), true);
        VoxelSums sums = sumsOf(fragmentColor(surface, weights).rgb, fragmentNormal(surface, weights));
        if (!kMixed)
            addToSums(childIndex(node, cell), sums);
        else if (isMixed(mixed, cell))
            addToSums(sumsIndex(mixed, cell), sums);
        else
            STORE_MEAN(childIndex(node, cell), sums, 0u);
    }
}

#endif
