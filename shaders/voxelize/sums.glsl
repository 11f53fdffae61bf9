// SPDX-License-Identifier: MIT
// Adds fragments to the sums of their voxels. Integers are added, so that every form leaves the same words in memory.
//
// INT64_ATOMICS: two words of VoxelSums are added as one 64-bit number. No word carries into the next: their values are
// not negative, and sums of kFragmentsMax of them fit. In sums of more the count of fragments is right nevertheless, by
// which the host sees that they do not fit.
//
// Needs params.sums and params.sum_shift.
#ifndef ZVO_SHADERS_VOXELIZE_SUMS_GLSL
#define ZVO_SHADERS_VOXELIZE_SUMS_GLSL

#include "lib/bound.glsl"
#include "voxelize/voxelize.h"

// SUM_PAIR, SUM_WORD: a pair of words, or a word, of the sums of a voxel.
#ifdef BOUND
#ifdef INT64_ATOMICS
STORAGE(2, uint64_t, sums);
#define SUM_PAIR(VOXEL, PAIR) storage_sums.data[kVoxelSumsBytes / 8u * (VOXEL) + (PAIR)]
#else
STORAGE(2, uint, sums);
#define SUM_WORD(VOXEL, WORD) storage_sums.data[kVoxelSumsBytes / 4u * (VOXEL) + (WORD)]
#endif
#else
#define SUM_PAIR(VOXEL, PAIR) uint64_t_Ptr(sumsAddress(VOXEL)).data[PAIR]
#define SUM_WORD(VOXEL, WORD) uint_Ptr(sumsAddress(VOXEL)).data[WORD]

uint64_t sumsAddress(uint voxel)
{
    return uint64_t(params.sums) + uint64_t(voxel) * kVoxelSumsBytes;
}
#endif

// The sums of one fragment. color: 16-bit fractions; normal: of length 32767.
VoxelSums sumsOf(uvec3 color, ivec3 normal)
{
    color >>= params.sum_shift;
    uvec3 biased = uvec3(normal >> params.sum_shift) + normalBias(params.sum_shift);
    return VoxelSums(color.r, color.g, color.b, biased.x, biased.y, biased.z, 1u, 0u);
}

// Adds a fragment. voxel: index of its sums.
void addToSums(uint voxel, VoxelSums sums)
{
#ifdef INT64_ATOMICS
    atomicAdd(SUM_PAIR(voxel, 0u), packUint2x32(uvec2(sums.red, sums.green)));
    atomicAdd(SUM_PAIR(voxel, 1u), packUint2x32(uvec2(sums.blue, sums.normal_x)));
    atomicAdd(SUM_PAIR(voxel, 2u), packUint2x32(uvec2(sums.normal_y, sums.normal_z)));
    atomicAdd(SUM_PAIR(voxel, 3u), 1ul);
#else
    atomicAdd(SUM_WORD(voxel, 0u), sums.red);
    atomicAdd(SUM_WORD(voxel, 1u), sums.green);
    atomicAdd(SUM_WORD(voxel, 2u), sums.blue);
    atomicAdd(SUM_WORD(voxel, 3u), sums.normal_x);
    atomicAdd(SUM_WORD(voxel, 4u), sums.normal_y);
    atomicAdd(SUM_WORD(voxel, 5u), sums.normal_z);
    atomicAdd(SUM_WORD(voxel, 6u), 1u);
#endif
}

#endif
