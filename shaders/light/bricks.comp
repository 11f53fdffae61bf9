#version 460
// SPDX-License-Identifier: MIT
// Makes the bricks of the light tree of leaves: a thread for each cell.
#extension GL_GOOGLE_include_directive : require
#include "light/light_tree.h"

GPU_ENTRY(LightBricksParams, LIGHT_BRICKS_CONSTANTS);
layout(local_size_x = kLightGroup) in;

#include "lib/color.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "light/bounds.glsl"
#include "light/item.glsl"

shared uint s_emissive[2];
shared uint s_exposed[2u * kLightFaces];
shared uint s_low[3];
shared uint s_high[3];
shared float s_luminance[kLightGroup];
shared float s_faces[kLightFaces];

// Whether the grid has a voxel there; coordinates outside of the root's cube have none.
bool isOccupied(uvec3 voxel)
{
    bool go = all(lessThan(voxel, uvec3(1u << (2u * kNodeLevels))));
    bool occupied = go;
    Node_ConstPtr pool = rankSourceOfTree().pool;
    uint reference = 0u;
    for (uint level = 0u; go; ++level)
    {
        uint cell = cellInBlock(voxel >> (2u * (kNodeLevels - 1u - level)));
        occupied = hasCell(nodeMask(pool, reference), cell);
        go = occupied && level + 1u < kNodeLevels;
        if (go)
            reference = listedChild(pool, childIndex(loadInner(pool, reference), cell), kEntriesPerWord);
    }
    return occupied;
}

uvec3 neighbor(uvec3 voxel, uint face)
{
    uvec3 axis = uvec3(face % 3u == 0u, face % 3u == 1u, face % 3u == 2u);
    return face < 3u ? voxel + axis : voxel - axis;
}

// The luminance of all exposed faces in a direction, summed in the order of the cells.
float sumOfFaces(uint face)
{
    float sum = 0.0;
    for (uint cell = 0u; cell < kLightGroup; ++cell)
    {
        bool exposed = ((s_exposed[2u * face + (cell >> 5)] >> (cell & 31u)) & 1u) != 0u;
        sum += exposed ? s_luminance[cell] : 0.0;
    }
    return sum;
}

void main()
{
    LightLevel level = params.levels.data[params.level];
    uint item = workgroupIndex();
    if (item >= level.count)
        return;
    uint cell = gl_LocalInvocationIndex;
    if (cell < 2u)
        s_emissive[cell] = 0u;
    if (cell < 2u * kLightFaces)
        s_exposed[cell] = 0u;
    if (cell < 3u)
    {
        s_low[cell] = ~0u;
        s_high[cell] = 0u;
    }
    s_luminance[cell] = 0.0;
    barrier();
    LightItem at = params.items.data[level.first + item];
    Node leaf = loadLeaf(at.node);
    leaf.base_lo += at.voxels;
    leaf.base_hi += at.voxels;
    uint voxel_index = childIndex(leaf, cell);
    uvec2_ConstPtr words = params.tree.data[0].emission_words;
    bool emits = false;
    if (hasChild(leaf, cell))
        emits = isEmissive(words, voxel_index);
    if (emits)
    {
        uint index = emissionIndex(words, voxel_index);
        s_luminance[cell] =
            params.tree.data[0].emission_scale * luminance(decodeRgb9e5(params.tree.data[0].emission.data[index]));
        atomicOr(s_emissive[cell >> 5], 1u << (cell & 31u));
        uvec3 voxel = 4u * at.cell + mortonDecode(cell);
        [[unroll]] for (uint axis = 0u; axis < 3u; ++axis)
        {
            atomicMin(s_low[axis], voxel[axis]);
            atomicMax(s_high[axis], voxel[axis]);
        }
        [[unroll]] for (uint face = 0u; face < kLightFaces; ++face)
            if (!isOccupied(neighbor(voxel, face)))
                atomicOr(s_exposed[2u * face + (cell >> 5)], 1u << (cell & 31u));
    }
    barrier();
    uint number = level.first + item;
    if (cell < kLightFaces)
    {
        s_faces[cell] = sumOfFaces(cell);
        params.bricks.data[item].exposed[cell] = uvec2(s_exposed[2u * cell], s_exposed[2u * cell + 1u]);
    }
    barrier();
    if (cell == 0u)
    {
        vec3 up = vec3(s_faces[0], s_faces[1], s_faces[2]);
        vec3 down = vec3(s_faces[3], s_faces[4], s_faces[5]);
        float power = dot(up + down, vec3(1.0));
        params.items.data[number].up = up;
        params.items.data[number].down = down;
        params.nodes.data[number] = LightNode(packLightCell(uvec3(s_low[0], s_low[1], s_low[2])),
                                              packLightCell(uvec3(s_high[0], s_high[1], s_high[2])), power,
                                              packLightParts(up, down, power), item, s_emissive[0], s_emissive[1], 0u);
        params.bricks.data[item].leaf = leaf;
        params.bricks.data[item].cell = at.cell;
    }
}
