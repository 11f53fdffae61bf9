// SPDX-License-Identifier: MIT
// Snaps a draw's triangle to the lattice. Every operation here is a single rounded addition or product, so that the
// result is the same on every device.
// Needs params.origin and params.lattice_scale, and params.scene as voxelize/loads.glsl does.
#ifndef ZVO_SHADERS_VOXELIZE_VERTEX_GLSL
#define ZVO_SHADERS_VOXELIZE_VERTEX_GLSL

#include "voxelize/loads.glsl"
#include "voxelize/voxelize.h"

// The exponent of a float: its lowest bit, its bits from there on, and what stands for 2^0.
const uint kExponentShift = 23u;
const uint kExponentMask = 255u;
const uint kExponentBias = 127u;

const uint kInverseSqrtBits = 1597463007u; // minus half the bits of x: those of about 1 / sqrt(x)

const float kUnitLength = 32767.0; // of a direction in integers

// World position of vertex v of a draw.
vec3 worldPosition(Draw draw, uint v)
{
    vec3 p = loadPosition(draw.first_vertex + v);
    precise vec3 world = draw.transform[0] * p.x;
    precise vec3 by_y = draw.transform[1] * p.y;
    precise vec3 by_z = draw.transform[2] * p.z;
    world = world + by_y;
    world = world + by_z;
    world = world + draw.transform[3];
    return world;
}

// Lattice position before conversion to integers: whole numbers where they are within kLatticeLimit.
vec3 latticePosition(vec3 world)
{
    precise vec3 offset = world - params.origin;
    precise vec3 scaled = offset * params.lattice_scale;
    return roundEven(scaled);
}

bool onLattice(vec3 q)
{
    return all(lessThanEqual(abs(q), vec3(float(kLatticeLimit))));
}

// 1 / sqrt(x) for normal positive x within 2^-22, from additions and products alone: Newton's method from the usual
// estimate by the exponent.
float inverseSqrt(float x)
{
    float y = uintBitsToFloat(kInverseSqrtBits - (floatBitsToUint(x) >> 1));
    precise float half_x = 0.5 * x;
    for (int i = 0; i < 3; ++i)
    {
        precise float square = y * y;
        precise float product = half_x * square;
        precise float correction = 1.5 - product;
        precise float next = y * correction;
        y = next;
    }
    return y;
}

// Direction of v with length kUnitLength, rounded to integers; 0 for a vector that is zero, tiny or not finite.
ivec3 unitNormal(vec3 v)
{
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    // Scaled by a power of two into [1, 2), so that squares neither overflow nor vanish.
    uint exponent = (floatBitsToUint(largest) >> kExponentShift) & kExponentMask;
    bool usable = exponent >= kDirectionExponentMin && exponent <= kDirectionExponentMax;
    exponent = usable ? exponent : kExponentBias;
    precise vec3 scaled = v * uintBitsToFloat((2u * kExponentBias - exponent) << kExponentShift);
    precise vec3 squares = scaled * scaled;
    precise float length2 = squares.x + squares.y;
    length2 = length2 + squares.z;
    precise vec3 unit = scaled * inverseSqrt(usable ? length2 : 1.0);
    precise vec3 fixed_point = unit * kUnitLength;
    vec3 rounded = clamp(roundEven(fixed_point), vec3(-kUnitLength), vec3(kUnitLength));
    return usable ? ivec3(rounded) : ivec3(0);
}

// World normal of a vertex of a draw.
vec3 worldNormal(Draw draw, vec3 n)
{
    precise vec3 world = draw.normal_transform[0] * n.x;
    precise vec3 by_y = draw.normal_transform[1] * n.y;
    precise vec3 by_z = draw.normal_transform[2] * n.z;
    world = world + by_y;
    world = world + by_z;
    return world;
}

#endif
