// SPDX-License-Identifier: MIT
// From sums over a voxel's fragments to its attribute and its emission.
// SUMS_BINDING (optional): the kernel's params have sums and max_fragments; the binding of sums in its bound form
// (lib/bound.glsl).
#ifndef ZVO_SHADERS_VOXELIZE_RESOLVE_GLSL
#define ZVO_SHADERS_VOXELIZE_RESOLVE_GLSL

#include "lib/arithmetic.glsl"
#include "lib/attribute.glsl"
#include "lib/bound.glsl"
#include "lib/normal.glsl"
#include "voxelize/voxelize.h"

// The sum of the fragments' normals.
ivec3 normalSum(VoxelSums sums, uint sum_shift)
{
    return ivec3(uvec3(sums.normal_x, sums.normal_y, sums.normal_z) - sums.fragments * normalBias(sum_shift));
}

// The mean of the fragments.
Attribute resolveSums(SceneView_ConstPtr scene, VoxelSums sums, uint sum_shift, uint flags)
{
    uint count = max(sums.fragments, 1u);
    uvec3 sum = uvec3(sums.red, sums.green, sums.blue);
    uvec3 color = min(divideSmall(sum + count / 2u, count) << sum_shift, uvec3(kFractionOne));
    uint normal = encodeMeanNormal(normalSum(sums, sum_shift), count, uint(kNormalOne) >> sum_shift);
    return Attribute(packColor(scene, color, flags), normal);
}

// Writes the mean of sums as the attribute of a voxel: one store, not two. Needs params.attributes, params.scene and
// params.sum_shift.
#define STORE_MEAN(VOXEL, SUMS, FLAGS)                                                                                 \
    uint64_t_Ptr(uint64_t(params.attributes)).data[VOXEL] =                                                            \
        packAttribute(resolveSums(params.scene, SUMS, params.sum_shift, FLAGS))

uint64_t packAttribute(Attribute mean)
{
    return packUint2x32(uvec2(mean.color, mean.normal));
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

void addSums(inout VoxelSums sums, VoxelSums more)
{
    sums.red += more.red;
    sums.green += more.green;
    sums.blue += more.blue;
    sums.normal_x += more.normal_x;
    sums.normal_y += more.normal_y;
    sums.normal_z += more.normal_z;
    sums.fragments += more.fragments;
}

// Sums whose values have lost `shift` bits; sum_shift: what their values are shifted by afterwards.
VoxelSums droppingBits(VoxelSums sums, uint shift, uint sum_shift)
{
    uvec3 normal =
        uvec3(normalSum(sums, sum_shift - shift) >> shift) + sums.fragments * normalBias(sum_shift);
    return VoxelSums(sums.red >> shift, sums.green >> shift, sums.blue >> shift, normal.x, normal.y, normal.z,
                     sums.fragments, 0u);
}

void addEmission(inout EmissionSums sums, EmissionSums more, uint shift)
{
    sums.red += more.red >> shift;
    sums.green += more.green >> shift;
    sums.blue += more.blue >> shift;
}

#ifdef SUMS_BINDING
#ifdef BOUND
TEXELS_4(SUMS_BINDING, sums);

VoxelSums loadSums(uint i)
{
    uvec4 a = texelFetch(texels4_sums, int(2u * i));
    uvec4 b = texelFetch(texels4_sums, int(2u * i + 1u));
    return VoxelSums(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}
#else
VoxelSums loadSums(uint i)
{
    return params.sums.data[i];
}
#endif

// Notes a voxel whose fragments are too many for its sums.
void noteFragments(VoxelSums sums)
{
    if ((sums.fragments >> params.sum_shift) > kFragmentsMax)
        atomicMax(params.max_fragments.data[0], sums.fragments);
}
#endif

#endif
