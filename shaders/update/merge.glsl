// SPDX-License-Identifier: MIT
// The voxels of touched leaves, and the layers' voxels at the same positions: what update/merge and
// update/merge_emission share, their constants and parameters included.
#ifndef ZVO_SHADERS_UPDATE_MERGE_GLSL
#define ZVO_SHADERS_UPDATE_MERGE_GLSL

#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/node.glsl"
#include "update/update.h"

GPU_ENTRY(MergeParams, MERGE_CONSTANTS);

const uint kNoVoxel = ~0u;

// Which leaf a thread works on, and the first of its voxels; the others are kMergeThreads apart.
#define mergeItem() (threadIndex() / kMergeThreads)
#define mergeFirst() (gl_LocalInvocationIndex % kMergeThreads)

// A touched leaf, in the overlay and in the base tree.
struct MergedLeaf
{
    Node node;
    Node base;      // its voxels that have attributes, with their indices
    uvec2 occupied; // all of its voxels
    uvec2 cut;      // voxels that layers take from the base tree
    uint look; // index of its attributes among those of nodes: before they are averaged, what is inside has their colour
    uint head;  // record + 1 of the first layer that has the leaf
    uint count; // of its voxels
};

MergedLeaf mergedLeaf(uint item)
{
    MergedLeaf leaf = MergedLeaf(Node(0u, 0u, 0u, 0u), Node(0u, 0u, 0u, 0u), uvec2(0u), uvec2(0u), 0u, 0u, 0u);
    LevelRange range = params.ranges.data[0];
    if (item < range.count)
    {
        uint entry = params.items.data[range.first + item].entry;
        TouchedNode touched = params.touched.data[entry];
        leaf.node = params.nodes.data[touched.node];
        if (touched.base != kNoNode)
        {
            leaf.base = loadSurfaceOf(params.nodes, params.leaf_groups, touched.base);
            leaf.occupied = nodeMask(params.nodes, touched.base);
        }
        leaf.look = touched.node + params.attribute_offset;
        uint first_voxel = kRanks ? params.ranks.data[touched.node].voxels : 0u;
        leaf.base.base_lo += first_voxel;
        leaf.base.base_hi += first_voxel;
        leaf.head = params.heads.data[entry];
        if (kCarves)
        {
            CarvedNode carved = params.state.data[0].carved.data[entry];
            leaf.cut = uvec2(carved.cut_lo, carved.cut_hi);
        }
        leaf.count = bitCount(leaf.node.mask_lo) + bitCount(leaf.node.mask_hi);
    }
    return leaf;
}

// Number of the n-th set bit of mask, which has more than n.
uint setBit(uint mask, uint n)
{
    uint bit = 0u;
    [[unroll]] for (uint width = 16u; width != 0u; width >>= 1u)
    {
        uint below = bitCount(bitfieldExtract(mask, int(bit), int(width)));
        bool above = below <= n;
        n -= above ? below : 0u;
        bit += above ? width : 0u;
    }
    return bit;
}

// A voxel of the overlay.
struct MergedVoxel
{
    uint index; // of its attribute
    uint base;  // of its attribute in the base tree; kInteriorIndex, or kNoVoxel
    uint cell;  // in its leaf
    uint head;  // record + 1 of the first layer that has the leaf
};

// The n-th voxel of a leaf.
MergedVoxel mergedVoxel(MergedLeaf leaf, uint n)
{
    uint count_lo = bitCount(leaf.node.mask_lo);
    MergedVoxel voxel;
    voxel.index = leaf.node.base_lo + n;
    voxel.cell = n < count_lo ? setBit(leaf.node.mask_lo, n) : 32u + setBit(leaf.node.mask_hi, n - count_lo);
    voxel.head = leaf.head;
    bool is_cut = kCarves && hasCell(leaf.cut, voxel.cell);
    voxel.base = hasCell(leaf.occupied, voxel.cell) && !is_cut ? kInteriorIndex : kNoVoxel;
    voxel.base = hasChild(leaf.base, voxel.cell) && !is_cut ? childIndex(leaf.base, voxel.cell) : voxel.base;
    return voxel;
}

// Whether the sums over the fragments of a base tree's voxel are kept.
bool hasBaseSums(MergedVoxel voxel)
{
    return voxel.base != kNoVoxel && voxel.base < params.view.data[0].base_voxel_count;
}

// A layer's voxel at the same position.
struct LayerVoxel
{
    Layer layer;
    uint record; // of the layer's leaf, + 1; 0: no more layers
    uint next;   // record + 1
    uint voxel;  // among the layer's voxels
    bool exists;
};

LayerVoxel layerVoxel(MergedVoxel voxel, uint record)
{
    LayerVoxel layer_voxel;
    layer_voxel.record = record;
    layer_voxel.next = 0u;
    layer_voxel.voxel = 0u;
    layer_voxel.exists = false;
    if (record != 0u)
    {
        LayerLink link = params.links.data[record - 1u];
        layer_voxel.layer = params.layers.data[link.layer];
        Node leaf = layer_voxel.layer.leaves.data[record - 1u - layer_voxel.layer.first_record];
        layer_voxel.next = link.next;
        layer_voxel.voxel = childIndex(leaf, voxel.cell);
        layer_voxel.exists = hasChild(leaf, voxel.cell);
    }
    return layer_voxel;
}

LayerVoxel firstLayerVoxel(MergedVoxel voxel)
{
    return layerVoxel(voxel, voxel.head);
}

LayerVoxel nextLayerVoxel(MergedVoxel voxel, LayerVoxel layer_voxel)
{
    return layerVoxel(voxel, layer_voxel.next);
}

bool emitsIn(LayerVoxel layer_voxel)
{
    return kEmits && uint64_t(layer_voxel.layer.emission_words) != 0ul &&
           isEmissive(layer_voxel.layer.emission_words, layer_voxel.voxel);
}

uint emissionIndexIn(LayerVoxel layer_voxel)
{
    return emissionIndex(layer_voxel.layer.emission_words, layer_voxel.voxel);
}

#endif
