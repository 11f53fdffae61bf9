// SPDX-License-Identifier: MIT
// From sums over a voxel's fragments to its attribute and its emission. The includer includes voxelize/voxelize.h.
#include "lib/attribute.glsl"

// The mean of the fragments.
Attribute resolveSums(SceneView_ConstPtr scene, VoxelSums sums, uint sum_shift, uint flags)
{
    uint count = max(sums.fragments, 1u);
    uvec3 sum = uvec3(sums.red, sums.green, sums.blue);
    uvec3 color = min(divideSmall(sum + count / 2u, count) << sum_shift, uvec3(kFractionOne));
    ivec3 normal = ivec3(sums.normal_x, sums.normal_y, sums.normal_z);
    return Attribute(packColor(scene, color, flags), encodeNormal(normal));
}

// 16-bit fractions to RGB9E5 (value = mantissa * 2^(exponent - 24)): the exponent fits the largest channel, what lies
// below nine bits is cut off.
uint encodeRgb9e5(uvec3 fraction)
{
    int top = findMSB(max(fraction.r, max(fraction.g, fraction.b)) | 1u);
    int shift = max(top - 8, 0); // to nine bits
    uvec3 mantissa = fraction >> shift;
    uint exponent = uint(shift + 8); // fractions count 2^-16
    return mantissa.r | (mantissa.g << 9) | (mantissa.b << 18) | (exponent << 27);
}

// The mean over all fragments, those that emit nothing included.
uint resolveEmission(EmissionSums sums, uint fragments, uint sum_shift)
{
    uint count = max(fragments, 1u);
    uvec3 sum = uvec3(sums.red, sums.green, sums.blue);
    return encodeRgb9e5(min(divideSmall(sum + count / 2u, count) << sum_shift, uvec3(kFractionOne)));
}

// Adds sums whose values have shift bits more.
void addSums(inout VoxelSums sums, VoxelSums more, uint shift)
{
    sums.red += more.red >> shift;
    sums.green += more.green >> shift;
    sums.blue += more.blue >> shift;
    sums.normal_x += uint(int(more.normal_x) >> shift);
    sums.normal_y += uint(int(more.normal_y) >> shift);
    sums.normal_z += uint(int(more.normal_z) >> shift);
    sums.fragments += more.fragments;
}

void addEmission(inout EmissionSums sums, EmissionSums more, uint shift)
{
    sums.red += more.red >> shift;
    sums.green += more.green >> shift;
    sums.blue += more.blue >> shift;
}
