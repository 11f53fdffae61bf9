#version 460
// SPDX-License-Identifier: MIT
// Writes the attributes of the voxels of changed leaves: as before the dab, or as the brush asks.
#extension GL_GOOGLE_include_directive : require
#include "edit/edit.h"

GPU_ENTRY(EditVoxelsParams, EDIT_VOXELS_CONSTANTS);

#include "edit/voxels.glsl"
#include "edit/cells.glsl"
#include "lib/normal.glsl"

Attribute stampLook(EditVoxel voxel)
{
    uint word = stampCell(voxel.leaf, voxel.bit);
    uint kept = kEmits ? ~0u : ~(kAttributeEmissive << 24);
    return Attribute(params.stamp.data[word] & kept, params.stamp.data[word + 1u]);
}

// The look of a voxel that the brush makes.
Attribute madeLook(uvec3 cell)
{
    ivec3 normal = brushNormal(params.brush, cell);
    return Attribute(params.brush.color, normal == ivec3(0) ? kNoNormal : encodeNormal(normal));
}

// The voxel of a stamp at a position, as the first word of its look, or ~0.
uint stampWordAt(uvec3 voxel)
{
    uint level = params.box.level_count - 1u;
    uint leaf = cellNumber(params.box, level, voxel >> 2);
    uint bit = cellInBlock(voxel);
    bool has_voxel = ((params.stamp.data[stampMask(leaf, bit)] >> (bit & 31u)) & 1u) != 0u;
    return has_voxel ? stampCell(leaf, bit) : ~0u;
}

// The normal of a voxel that a brush lays bare as it takes a neighbour by a face: into the brush; or against the normals
// of what a stamp takes there, if that has some, and else towards it. Zero for other voxels.
ivec3 exposedNormal(uvec3 cell)
{
    uvec3 lo = boxLow(params.brush, params.box);
    uvec3 hi = boxHigh(params.brush, params.box);
    bool bare = false;
    ivec3 taken = ivec3(0); // the sum of normals
    ivec3 open = ivec3(0);  // the sum of directions
    [[unroll]] for (uint side = 0u; side < 6u; ++side)
    {
        uvec3 beside = besideFace(cell, side);
        if (any(lessThan(beside, lo)) || any(greaterThan(beside, hi)))
            continue;
        if (kStamp)
        {
            uint word = stampWordAt(beside);
            taken += word != ~0u ? decodeNormal(params.stamp.data[word + 1u]) : ivec3(0);
            open += word != ~0u ? ivec3(beside) - ivec3(cell) : ivec3(0);
        }
        else
        {
            bare = bare || isUnderBrush(params.brush, beside);
        }
    }
    if (kStamp)
        return taken != ivec3(0) ? -taken : open;
    return bare ? -brushNormal(params.brush, cell) : ivec3(0);
}

// The look of a voxel that was there before.
Attribute keptLook(EditVoxel voxel)
{
    Attribute before;
    if (voxel.base == kInteriorIndex)
        before = interiorLook(params.node_attributes.data[voxel.around]);
    else
        before = params.attributes.data[voxel.base];
    if (kExposes && before.normal == kNoNormal)
    {
        ivec3 normal = exposedNormal(voxel.cell);
        before.normal = normal != ivec3(0) ? encodeNormal(normal) : kNoNormal;
    }
    return Attribute(isPainted(voxel) ? params.brush.color : before.color, before.normal);
}

void main()
{
    EditVoxel voxel = editVoxel();
    if (!voxel.exists)
        return;
    Attribute look;
    if (isStamped(voxel))
        look = stampLook(voxel);
    else if (voxel.base == kNoEditNode)
        look = madeLook(voxel.cell);
    else
        look = keptLook(voxel);
    params.attributes.data[voxel.index] = look;
    if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
        atomicOr(params.emission_words.data[voxel.index >> 5].x, 1u << (voxel.index & 31u));
}
