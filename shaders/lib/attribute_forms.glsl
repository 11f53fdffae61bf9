// SPDX-License-Identifier: MIT
// Attributes out of any form, in integers: src/core/attribute_form.cpp is the same for the host.
#include "lib/attribute.glsl"
#include "shared/attribute_forms.h"

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
    return Attribute(color.r | (color.g << 8) | (color.b << 16),
                     (uint(normal.x) & kFractionOne) | (uint(normal.y) << 16));
}

// The attribute of a voxel or, where voxel is not set, of a node.
Attribute readAttribute(uint form, bool voxel, Attribute_ConstPtr voxels, Attribute_ConstPtr nodes, uint index)
{
    uint64_t address = voxel ? uint64_t(voxels) : uint64_t(nodes);
    if (form == kForm4)
        return unpackAttribute4(uint_ConstPtr(address).data[index]);
    uvec2 stored = unpackUint2x32(uint64_t_ConstPtr(address).data[index]);
    return Attribute(stored.x, stored.y);
}
