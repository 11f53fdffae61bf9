// SPDX-License-Identifier: MIT
// The voxels of touched leaves, and the layers' voxels in the same places. The includer includes update/update.h.
#include "lib/node.glsl"

layout(constant_id = 0) const uint kMerge = kMergeAverage;
layout(constant_id = 1) const bool kEmits = false;

layout(push_constant, scalar) uniform Push
{
    MergeParams params;
};

const uint kNoVoxel = ~0u;

// A voxel of the overlay.
struct MergedVoxel
{
    uint index; // of its attribute
    uint base;  // likewise in the base octree, or kNoVoxel
    uint cell;  // in its leaf
    uint head;  // record + 1 of the first layer that has the leaf
};

// The voxel in a cell of a touched leaf; false if there is none.
bool findVoxel(uint item, uint cell, out MergedVoxel voxel)
{
    voxel = MergedVoxel(0u, kNoVoxel, cell, 0u);
    LevelRange range = params.ranges.data[0];
    if (item >= range.count)
        return false;
    uint entry = params.items.data[range.first + item].entry;
    TouchedNode touched = params.touched.data[entry];
    Node node = params.nodes.data[touched.node];
    voxel.index = childIndex(node, cell);
    voxel.head = params.heads.data[entry];
    if (touched.base != kNoNode)
    {
        Node base = params.nodes.data[touched.base];
        voxel.base = hasChild(base, cell) ? childIndex(base, cell) : kNoVoxel;
    }
    return hasChild(node, cell);
}

// What a layer has in the place of a voxel.
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
    LayerVoxel place;
    place.record = record;
    place.next = 0u;
    place.voxel = 0u;
    place.exists = false;
    if (record != 0u)
    {
        LayerLink link = params.links.data[record - 1u];
        place.layer = params.layers.data[link.layer];
        Node leaf = place.layer.leaves.data[record - 1u - place.layer.first_record];
        place.next = link.next;
        place.voxel = childIndex(leaf, voxel.cell);
        place.exists = hasChild(leaf, voxel.cell);
    }
    return place;
}

LayerVoxel firstLayerVoxel(MergedVoxel voxel)
{
    return layerVoxel(voxel, voxel.head);
}

LayerVoxel nextLayerVoxel(MergedVoxel voxel, LayerVoxel place)
{
    return layerVoxel(voxel, place.next);
}

bool emitsIn(LayerVoxel place)
{
    return kEmits && uint64_t(place.layer.emission_words) != 0ul &&
           ((place.layer.emission_words.data[place.voxel >> 5].x >> (place.voxel & 31u)) & 1u) != 0u;
}

uint emissionPlaceIn(LayerVoxel place)
{
    uvec2 word = place.layer.emission_words.data[place.voxel >> 5];
    return word.y + bitCount(word.x & ((1u << (place.voxel & 31u)) - 1u));
}
