#version 460
// SPDX-License-Identifier: MIT
// Packs the normals of 16 voxels into 16 bytes: two scales of octahedral coordinates, of which each voxel has one of
// eight steps (the form of BC5). An octahedral map is torn below its equator, where a block would need its whole scale.
// So each block has its own frame: one of six poles, and coordinates along the axes or along the diagonals, whichever
// gives the smallest sum of squared distances on the octahedron. A scale goes from the least to the greatest
// coordinate, or is the least squares for the voxels' steps on that one. All in integers, with 1 as 4095. A block of
// which more than half of the voxels have no normal has none.
#extension GL_GOOGLE_include_directive : require
#include "attributes/attributes.h"

GPU_ENTRY(PackBlocksParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPackGroup) in;

#include "attributes/block.glsl"
#include "lib/attribute_formats.glsl"
#include "lib/dispatch.glsl"
#include "lib/normal.glsl"

const uint kFrames = 12u;

ivec3 normals[kBlockVoxels]; // the absolute values of their components add up to kOne

// The vector of a code, whose components' absolute values add up to kOne.
ivec3 vectorOf(uint code)
{
    ivec2 p = max(normalCoordinates(code), ivec2(-kNormalOne));
    return unfoldNormal(sign(p) * ((abs(p) * kOne + kNormalOne / 2) / kNormalOne), kOne);
}

uint loadCode(uint index)
{
    return params.attributes.data[min(index, params.count - 1u)].normal;
}

// Loads the normals of a block. For one that is missing stands in the last one before it, else the first one of all.
// Returns how many are missing.
uint loadNormals(uint first)
{
    uint code = kNoNormal;
    for (uint i = 0u; i < kBlockVoxels && code == kNoNormal; ++i)
        code = loadCode(first + i);
    uint missing = 0u;
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        uint own = loadCode(first + i);
        bool is_missing = own == kNoNormal;
        missing += is_missing ? 1u : 0u;
        code = is_missing ? code : own;
        normals[i] = vectorOf(code);
    }
    return missing;
}

// Rotates v from the axes of the grid to a frame whose pole is z.
ivec3 turned(ivec3 v, uint frame)
{
    uint axis = frame & kFrameAxis;
    v = axis == 0u ? v.yzx : (axis == 1u ? v.zxy : v);
    v.z = (frame & kFrameNegative) != 0u ? -v.z : v.z;
    return v;
}

void findPoints(uint frame)
{
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        ivec3 v = turned(normals[i], frame);
        ivec2 p = foldNormal(abs(v.xy), v, kOne);
        ivec2 diagonal = ivec2(p.x + p.y, p.x - p.y) >> 1;
        points[i] = uvec2(((frame & kFrameDiagonal) != 0u ? diagonal : p) + kOne);
    }
}

// Sum of squared distances on the octahedron: 16 * 3 * 8190^2 at most.
uint errorOf(Scales scales, uint frame)
{
    uint error = 0u;
    for (uint i = 0u; i < kBlockVoxels; ++i)
    {
        ivec2 p = ivec2(pointAt(scales, blockIndices(scales.planes, i))) - kOne;
        ivec3 d = blockVector(p, frame, kOne) - turned(normals[i], frame);
        error += uint(d.x * d.x + d.y * d.y + d.z * d.z);
    }
    return error;
}

void main()
{
    uint block = threadIndex();
    if (block > (params.count - 1u) / kBlockVoxels)
        return;
    uint missing = loadNormals(block * kBlockVoxels);
    uvec4 best = uvec4(0u);
    uint best_error = ~0u;
    for (uint i = 0u; i < kFrames; ++i)
    {
        uint frame = i % kFrameAxes | (i / kFrameAxes * kFrameNegative);
        findPoints(frame);
        Scales full = fullScales();
        Scales scales = better(full, leastSquares(full));
        uint error = errorOf(scales, frame);
        if (error < best_error)
        {
            best_error = error;
            best = uvec4(scales.first.x | (scales.second.x << kEndBits) | (scales.first.y << (2u * kEndBits)) |
                             (scales.second.y << (3u * kEndBits)) | (frame << kFrameShift),
                         scales.planes);
        }
    }
    if (2u * missing > kBlockVoxels)
        best = uvec4(kFrameNone << kFrameShift, uvec3(0u));
    uint word = block * kBlockWords + kBlockNormals;
    params.words.data[word] = best.x;
    params.words.data[word + 1u] = best.y;
    params.words.data[word + 2u] = best.z;
    params.words.data[word + 3u] = best.w;
}
