#version 460
// SPDX-License-Identifier: MIT
// Writes the attributes of the voxels of each touched leaf: those of the base tree where no layer has the voxel, else
// by kMerge.
#extension GL_GOOGLE_include_directive : require
#include "update/merge.glsl"
#include "voxelize/resolve.glsl"

layout(local_size_x = kUpdateGroup) in;

// What the voxel looks like in the base tree.
Attribute baseLook(MergedLeaf leaf, MergedVoxel voxel)
{
    if (voxel.base == kInteriorIndex)
        return interiorLook(params.node_attributes.data[leaf.look]);
    Attribute look = Attribute(0u, 0u);
    if (voxel.base != kNoVoxel)
        look = params.attributes.data[voxel.base];
    return look;
}

void mergeVoxel(MergedLeaf leaf, MergedVoxel voxel)
{
    SceneView_ConstPtr scene = params.view.data[0].scene;
    Attribute look = baseLook(leaf, voxel);
    VoxelSums sums = VoxelSums(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    bool emits = false;
    LayerVoxel layer_voxel = firstLayerVoxel(voxel);
    for (uint i = 0u; i < kLayersMax && layer_voxel.record != 0u; ++i)
    {
        if (layer_voxel.exists)
        {
            addSums(sums, layer_voxel.layer.sums.data[layer_voxel.voxel]);
            emits = emits || emitsIn(layer_voxel);
        }
        layer_voxel = nextLayerVoxel(voxel, layer_voxel);
    }
    bool dynamic = sums.fragments != 0u && !(kMerge == kMergeStatic && voxel.base != kNoVoxel);
    if (dynamic)
    {
        uint flags = emits ? kAttributeEmissive : 0u;
        if (kMerge == kMergeAverage && hasBaseSums(voxel))
        {
            VoxelSums base = params.view.data[0].sums.data[voxel.base];
            addSums(sums, droppingBits(base, params.view.data[0].base_shift, params.sum_shift));
            flags |= look.color >> 24;
        }
        if (sums.fragments > kFragmentsMax)
            atomicMax(params.state.data[0].status.max_fragments, sums.fragments);
        look = resolveSums(scene, sums, params.sum_shift, flags);
    }
    params.attributes.data[voxel.index] = look;
    if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
        atomicOr(params.emission_words.data[voxel.index >> 5].x, 1u << (voxel.index & 31u));
}

void main()
{
    MergedLeaf leaf = mergedLeaf(mergeItem());
    for (uint n = mergeFirst(); n < leaf.count; n += kMergeThreads)
        mergeVoxel(leaf, mergedVoxel(leaf, n));
}
