// SPDX-License-Identifier: MIT
// Packing of hits (shared/trace.h). Hits move as 64-bit words: lavapipe pays per word, not per byte.
#ifndef ZVO_SHADERS_LIB_HIT_GLSL
#define ZVO_SHADERS_LIB_HIT_GLSL

#include "shared/trace.h"

const uint kHitCoordinateMask = (1u << kHitCoordinateBits) - 1u;

uint64_t packHitCell(uvec3 cell, uint level, uint face)
{
    uint low = cell.x | (cell.y << 18);
    uint high = (cell.y >> 14) | (cell.z << 4) | (level << (kHitLevelShift - 32u)) | (face << (kHitFaceShift - 32u));
    return packUint2x32(uvec2(low, high));
}

void storeHit(Hit_Ptr hits, uint i, float t, uint index, uvec3 cell, uint level, uint face)
{
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(hits));
    words.data[2u * i] = packUint2x32(uvec2(floatBitsToUint(t), index));
    words.data[2u * i + 1u] = packHitCell(cell, level, face);
}

void storeMiss(Hit_Ptr hits, uint i)
{
    uint64_t_Ptr(uint64_t(hits)).data[2u * i] = packUint2x32(uvec2(0u, kHitMiss));
}

Hit loadHit(Hit_ConstPtr hits, uint i)
{
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(hits));
    uvec2 what = unpackUint2x32(words.data[2u * i]);
    return Hit(uintBitsToFloat(what.x), what.y, unpackUint2x32(words.data[2u * i + 1u]));
}

bool isMiss(Hit hit)
{
    return hit.index == kHitMiss;
}

uvec3 hitCell(Hit hit)
{
    return uvec3(hit.where.x, (hit.where.x >> 18) | (hit.where.y << 14), hit.where.y >> 4) & kHitCoordinateMask;
}

uint hitLevel(Hit hit)
{
    return bitfieldExtract(hit.where.y, int(kHitLevelShift - 32u), 4);
}

uint hitFace(Hit hit)
{
    return bitfieldExtract(hit.where.y, int(kHitFaceShift - 32u), 2);
}

#endif
