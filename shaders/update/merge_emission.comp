#version 460
// SPDX-License-Identifier: MIT
// Writes the emission of the emissive voxels of each touched leaf, by the same rule as their colour.
#extension GL_GOOGLE_include_directive : require
#include "update/merge.glsl"
#include "lib/emission.glsl"
#include "voxelize/resolve.glsl"

layout(local_size_x = kUpdateGroup) in;

void mergeEmission(MergedVoxel voxel)
{
    uvec2_ConstPtr words = uvec2_ConstPtr(uint64_t(params.emission_words));
    if (((params.attributes.data[voxel.index].color >> 24) & kAttributeEmissive) == 0u)
        return;
    bool base_emits = false;
    if (voxel.base < kInteriorIndex)
        base_emits = ((params.attributes.data[voxel.base].color >> 24) & kAttributeEmissive) != 0u;
    EmissionSums sums = EmissionSums(0u, 0u, 0u);
    uint fragments = 0u;
    LayerVoxel layer_voxel = firstLayerVoxel(voxel);
    for (uint i = 0u; i < kLayersMax && layer_voxel.record != 0u; ++i)
    {
        if (layer_voxel.exists)
        {
            fragments += layer_voxel.layer.sums.data[layer_voxel.voxel].fragments;
            if (emitsIn(layer_voxel))
                addEmission(sums, layer_voxel.layer.emission_sums.data[emissionIndexIn(layer_voxel)], 0u);
        }
        layer_voxel = nextLayerVoxel(voxel, layer_voxel);
    }
    uint result = 0u;
    if (fragments != 0u && !(kMerge == kMergeStatic && voxel.base != kNoVoxel))
    {
        if (kMerge == kMergeAverage && hasBaseSums(voxel))
        {
            fragments += params.view.data[0].sums.data[voxel.base].fragments;
            if (base_emits)
                addEmission(sums, params.view.data[0].emission_sums.data[emissionIndex(words, voxel.base)],
                            params.view.data[0].base_shift);
        }
        result = resolveEmission(sums, fragments, params.sum_shift);
    }
    else
    {
        result = params.emission.data[emissionIndex(words, voxel.base)];
    }
    params.emission.data[emissionIndex(words, voxel.index)] = result;
}

void main()
{
    MergedLeaf leaf = mergedLeaf(mergeItem());
    for (uint n = mergeFirst(); n < leaf.count; n += kMergeThreads)
        mergeEmission(mergedVoxel(leaf, n));
}
