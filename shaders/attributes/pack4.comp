#version 460
// SPDX-License-Identifier: MIT
// Attributes in 4 bytes: the nearest colour in 5, 6 and 5 bits, and of the four octahedral codes of 2 x 8 bits around a
// normal the one at the smallest angle (Z. Cigolle et al., A Survey of Efficient Representations for Independent Unit
// Vectors, 2014, who round down or up by the same search). In integers: the angle is compared by its squared cosine.
#extension GL_GOOGLE_include_directive : require
#include "attributes/attributes.h"

GPU_ENTRY(PackWordsParams, GPU_NO_CONSTANTS);
layout(local_size_x = kPackGroup) in;

#include "attributes/block.glsl"
#include "lib/dispatch.glsl"
#include "lib/normal.glsl"

uint64_t square(int a)
{
    return uint64_t(a) * uint64_t(a);
}

// The code of 2 x 8 bits whose direction is nearest to v's; p: the octahedral code of v.
ivec2 nearestNormal4(ivec2 p, ivec3 v)
{
    ivec2 low = ivec2(uvec2(p + kNormalOne) * uint(kNormalOne4) / uint(kNormalOne)) - kNormalOne4;
    ivec2 best = low;
    uint64_t best_dot2 = 0ul; // of v with the candidate, squared
    uint64_t best_length2 = 1ul;
    for (uint i = 0u; i < 4u; ++i)
    {
        ivec2 candidate = min(low + ivec2(i & 1u, i >> 1), ivec2(kNormalOne4));
        ivec3 c = unfoldNormal(candidate, kNormalOne4);
        uint64_t dot2 = square(max(v.x * c.x + v.y * c.y + v.z * c.z, 0));
        uint64_t length2 = uint64_t(c.x * c.x + c.y * c.y + c.z * c.z);
        if (dot2 * best_length2 > best_dot2 * length2)
        {
            best = candidate;
            best_dot2 = dot2;
            best_length2 = length2;
        }
    }
    return best;
}

void main()
{
    uint index = threadIndex();
    if (index >= params.count)
        return;
    Attribute look = params.attributes.data[index];
    ivec2 p = max(normalCoordinates(look.normal), ivec2(-kNormalOne));
    ivec2 normal = nearestNormal4(p, unfoldNormal(p, kNormalOne));
    uint code = (uint(normal.x) & 255u) | (uint(normal.y) & 255u) << 8;
    params.words.data[index] = packColor565(nearestColor565(splitColor(look.color))) |
                               (look.normal == kNoNormal ? kNoNormal4 : code) << kNormalShift4;
}
