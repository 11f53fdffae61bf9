#version 460
// SPDX-License-Identifier: MIT
// What the emissive voxels of each touched leaf emit, by the same rule as their colour.
#extension GL_GOOGLE_include_directive : require
#include "update/update.h"
#include "lib/dispatch.glsl"
#include "lib/merge.glsl"
#include "lib/resolve.glsl"

layout(local_size_x = kUpdateGroup) in;

uint emissionPlace(uint voxel)
{
    uvec2 word = params.emission_words.data[voxel >> 5];
    return word.y + bitCount(word.x & ((1u << (voxel & 31u)) - 1u));
}

void mergeEmission(MergedVoxel voxel)
{
    if (((params.attributes.data[voxel.index].color >> 24) & kAttributeEmissive) == 0u)
        return;
    bool base_emits = false;
    if (voxel.base != kNoVoxel)
        base_emits = ((params.attributes.data[voxel.base].color >> 24) & kAttributeEmissive) != 0u;
    EmissionSums sums = EmissionSums(0u, 0u, 0u);
    uint fragments = 0u;
    LayerVoxel place = firstLayerVoxel(voxel);
    for (uint i = 0u; i < kLayersMax && place.record != 0u; ++i)
    {
        if (place.exists)
        {
            fragments += place.layer.sums.data[place.voxel].fragments;
            if (emitsIn(place))
                addEmission(sums, place.layer.emission_sums.data[emissionPlaceIn(place)], 0u);
        }
        place = nextLayerVoxel(voxel, place);
    }
    uint result = 0u;
    if (fragments != 0u && !(kMerge == kMergeStatic && voxel.base != kNoVoxel))
    {
        if (kMerge == kMergeAverage && voxel.base != kNoVoxel)
        {
            fragments += params.view.data[0].sums.data[voxel.base].fragments;
            if (base_emits)
                addEmission(sums, params.view.data[0].emission_sums.data[emissionPlace(voxel.base)],
                            params.view.data[0].base_shift);
        }
        result = resolveEmission(sums, fragments, params.sum_shift);
    }
    else
    {
        result = params.emission.data[emissionPlace(voxel.base)];
    }
    params.emission.data[emissionPlace(voxel.index)] = result;
}

void main()
{
    MergedLeaf leaf = mergedLeaf(mergeItem());
    for (uint n = mergeFirst(); n < leaf.count; n += kMergeThreads)
        mergeEmission(mergedVoxel(leaf, n));
}
