// SPDX-License-Identifier: MIT
// Unpacks attributes of all formats, in integers; src/core/tree/attribute_format.cpp does the same on the host.
#ifndef ZVO_SHADERS_LIB_ATTRIBUTE_FORMATS_GLSL
#define ZVO_SHADERS_LIB_ATTRIBUTE_FORMATS_GLSL

#include "lib/normal.glsl"
#include "shared/attribute_formats.h"

// 8 bits a channel of a colour in 5, 6 and 5 bits: c * 255 / 31 and c * 255 / 63, rounded.
uvec3 unpackColor565(uint code)
{
    uvec3 channels = uvec3(bitfieldExtract(code, 0, int(kRedBits)),
                           bitfieldExtract(code, int(kRedBits), int(kGreenBits)),
                           bitfieldExtract(code, int(kRedBits + kGreenBits), int(kBlueBits)));
    return (channels * uvec3(527u, 259u, 527u) + uvec3(23u, 33u, 23u)) >> 6;
}

// The snorm16 codes of two snorm8: v * 32767 / 127, rounded.
ivec2 widenNormal4(ivec2 v)
{
    return v * 258 + ivec2(greaterThanEqual(v, ivec2(64))) - ivec2(lessThanEqual(v, ivec2(-64)));
}

Attribute unpackAttribute4(uint word)
{
    uvec3 color = unpackColor565(word);
    ivec2 normal = widenNormal4(ivec2(int(word << 8) >> 24, int(word) >> 24));
    bool has_normal = word >> kNormalShift4 != kNoNormal4;
    return Attribute(color.r | (color.g << 8) | (color.b << 16), has_normal ? normalCode(normal) : kNoNormal);
}

// Converts coordinates of a block, in which 1 is `one`, to a vector with the pole as z.
ivec3 blockVector(ivec2 p, uint frame, int one)
{
    ivec2 turned = clamp(ivec2(p.x + p.y, p.x - p.y), ivec2(-one), ivec2(one));
    return unfoldNormal((frame & kFrameDiagonal) != 0u ? turned : p, one);
}

// Rotates a vector from a block's frame, with the pole as z, to the axes of the grid.
ivec3 unturned(ivec3 v, uint frame)
{
    v.z = (frame & kFrameNegative) != 0u ? -v.z : v.z;
    uint axis = frame & kFrameAxis;
    return axis == 0u ? v.zxy : (axis == 1u ? v.yzx : v);
}

// The indices of a voxel: three words hold a bit of each, the lower 16 bits for x, the upper ones for y.
uvec2 blockIndices(uvec3 planes, uint voxel)
{
    uvec3 x = (planes >> voxel) & 1u;
    uvec3 y = (planes >> (voxel + kBlockVoxels)) & 1u;
    return uvec2(x.x | (x.y << 1) | (x.z << 2), y.x | (y.y << 1) | (y.z << 2));
}

uint unpackBlockColor(uint ends, uint indices, uint voxel)
{
    uint index = (indices >> (2u * voxel)) & kColorIndexMax;
    uvec3 sum = unpackColor565(ends) * (kColorIndexMax - index) + unpackColor565(ends >> 16) * index;
    uvec3 color = (sum + kColorIndexMax / 2u) / kColorIndexMax;
    return color.r | (color.g << 8) | (color.b << 16);
}

uint unpackBlockNormal(uint ends, uvec3 planes, uint voxel)
{
    uvec2 index = blockIndices(planes, voxel);
    ivec2 first = ivec2(uvec2(ends, ends >> (2u * kEndBits)) & ((1u << kEndBits) - 1u)) - kNormalEnd;
    ivec2 second = ivec2(uvec2(ends >> kEndBits, ends >> (3u * kEndBits)) & ((1u << kEndBits) - 1u)) - kNormalEnd;
    ivec2 sum = first * ivec2(kNormalIndexMax - index) + second * ivec2(index);
    const int sum_one = kNormalEnd * int(kNormalIndexMax);
    ivec2 p = sign(sum) * ((abs(sum) * kNormalOne + sum_one / 2) / sum_one);
    uint frame = ends >> kFrameShift;
    if ((frame & kFrameAxis) == kFrameNone)
        return kNoNormal;
    ivec3 v = unturned(blockVector(p, frame, kNormalOne), frame);
    return normalCode(foldNormal(abs(v.xy), v, kNormalOne));
}

Attribute unpackBlock(uint_ConstPtr words, uint index)
{
    uint first = index / kBlockVoxels * kBlockWords;
    uint voxel = index % kBlockVoxels;
    uvec3 planes = uvec3(words.data[first + kBlockNormalIndices], words.data[first + kBlockNormalIndices + 1u],
                         words.data[first + kBlockNormalIndices + 2u]);
    return Attribute(unpackBlockColor(words.data[first], words.data[first + kBlockColorIndices], voxel),
                     unpackBlockNormal(words.data[first + kBlockNormals], planes, voxel));
}

Attribute readStored(uint format, uint64_t address, uint index)
{
    if (format != kFormat8)
        return unpackAttribute4(uint_ConstPtr(address).data[index]);
    uvec2 stored = unpackUint2x32(uint64_t_ConstPtr(address).data[index]);
    return Attribute(stored.x, stored.y);
}

// The attribute of a voxel or, where voxel is not set, of a node.
Attribute readAttribute(uint format, bool voxel, Attribute_ConstPtr voxels, Attribute_ConstPtr nodes, uint index)
{
    if (index >= kInteriorIndex) // what is inside has the mean colour of all
    {
        Attribute mean = readStored(format, uint64_t(nodes), 0u);
        return Attribute(mean.color & kColorMask, kNoNormal);
    }
    if (format == kFormatBlocks && voxel)
        return unpackBlock(uint_ConstPtr(uint64_t(voxels)), index);
    return readStored(format, voxel ? uint64_t(voxels) : uint64_t(nodes), index);
}

#endif
