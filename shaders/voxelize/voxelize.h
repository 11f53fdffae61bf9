// SPDX-License-Identifier: MIT
// What the voxelization kernels share with the host.
#ifndef ZVO_SHADERS_VOXELIZE_VOXELIZE_H
#define ZVO_SHADERS_VOXELIZE_VOXELIZE_H

#include "shared/bricks.h"
#include "shared/lattice.h"
#include "shared/octree.h"
#include "shared/scene.h"

GPU_ENUM(Coverage) // kCoverageConservative, kCoverageThin
#define GPU_TYPE_Coverage uint
GPU_ENUM(Fill) // kFillNone and so on
#define GPU_TYPE_Fill uint
GPU_ENUM(MaterialClass) // kClassPlain and so on
#define GPU_TYPE_MaterialClass uint
GPU_ENUM(RasterMode) // kModeCoverage and so on
#define GPU_TYPE_RasterMode uint

GPU_NAMESPACE_BEGIN

const uint kChunkTriangles = 64u;  // triangles of one draw that one workgroup takes
const uint kSingleTriangles = 24u; // a draw of fewer shares workgroups with others
const uint kResolveGroup = 64u;    // threads of a workgroup where one thread takes one voxel
const int kSmallExtent = 8192;     // lattice units: a triangle up to this size is rasterized in 32-bit integers
const int kTileExtent = 1 << 26;   // lattice units: the columns of a triangle up to this size are walked
const uint kGroupsXMax = 65535u;   // workgroups along x that every device allows
const uint kFragmentsMax = 65535u; // fragments of a voxel that 32-bit sums hold

const int kLatticeLimit = 1 << 29; // vertices beyond are dropped

// Specialization constant coverage: which voxels a triangle covers.
const uint kCoverageConservative = 0u;
const uint kCoverageThin = 1u;

// Specialization constant fill: which voxels are inside, by their winding number (docs/voxelization.md).
const uint kFillNone = 0u;
const uint kFillSolid = 1u;  // it is not 0
const uint kFillParity = 2u; // it is odd
const uint kFillRobust = 3u; // it is not 0 along most of six rays, and of what neighbours say

// Specialization constant mode: what is done with a fragment.
const uint kModeCoverage = 0u;   // sets the voxel's bit
const uint kModeAttributes = 1u; // adds its colour and normal to the voxel's sums
const uint kModeEmission = 2u;   // adds its emission to the emissive voxel's sums

// Specialization constant material_class: what the materials of the draws need.
const uint kClassPlain = 0u;    // no textures, opaque
const uint kClassTextured = 1u; // opaque
const uint kClassAlpha = 2u;    // alpha decides which fragments exist
const uint kClassCount = 3u;

/// Sums over the fragments of a voxel, values shifted right by sum_shift. 32 bytes: one sector of memory, and four
/// pairs of words that are 64-bit numbers to 64-bit atomics. No sum of fewer than
/// (kFragmentsMax + 1) << sum_shift values carries.
struct VoxelSums
{
    uint red; // linear, 16-bit fractions
    uint green;
    uint blue;
    uint normal_x; // length 32767; shifted, each value has normalBias() added, so that none is negative
    uint normal_y;
    uint normal_z;
    uint fragments;
    uint zero; // always 0: the upper half of the 64-bit number whose lower half is fragments
};
GPU_BUFFER(VoxelSums, 8);

const uint kVoxelSumsBytes = 32u;

/// What is added to each component of a fragment's normal that was shifted right by sum_shift.
GPU_FUNCTION uint normalBias(uint sum_shift)
{
    return sum_shift < 16u ? 32768u >> sum_shift : 1u;
}

/// Sums of the emission of an emissive voxel: 16-bit fractions of the scene's brightest emission.
struct EmissionSums
{
    uint red;
    uint green;
    uint blue;
};
GPU_BUFFER(EmissionSums, 4);

/// Triangles [first_triangle, first_triangle + kChunkTriangles) of a draw; of a draw that shares workgroups, the first
/// of these alone.
struct Chunk
{
    uint draw;
    uint first_triangle;
};
GPU_BUFFER(Chunk, 4);

struct ResolveParams // push constants of voxelize/resolve
{
    GPU_CONST_PTR(SceneView) scene;
    GPU_CONST_PTR(VoxelSums) sums;       // [voxel_count]
    GPU_CONST_PTR(uvec2) emission_words; // [ceil(voxel_count / 32)], or null without emission
    GPU_PTR(Attribute) attributes;       // [voxel_count]
    GPU_PTR(uint) max_fragments;         // [1] raised to the largest fragment count of a voxel
    uint voxel_count;
    uint has_emission;
    uint sum_shift;
};
GPU_KERNEL(voxelize, resolve, Resolve, ResolveParams, GPU_NO_CONSTANTS)

struct EmissionRankParams // push constants of voxelize/emission_count and voxelize/emission_rank
{
    GPU_PTR(uvec2) words;   // [word_count] bits, rank
    GPU_PTR(uint) partials; // [ceil(word_count / kScanBlock)]
    uint word_count;
};
GPU_KERNEL(voxelize, emission_count, EmissionCount, EmissionRankParams, GPU_NO_CONSTANTS)
GPU_KERNEL(voxelize, emission_rank, EmissionRank, EmissionRankParams, GPU_NO_CONSTANTS)

struct ResolveEmissionParams // push constants of voxelize/resolve_emission
{
    GPU_CONST_PTR(VoxelSums) sums;             // [voxel_count]
    GPU_CONST_PTR(EmissionSums) emission_sums; // [emissive voxels]
    GPU_CONST_PTR(uvec2) emission_words;       // [ceil(voxel_count / 32)]
    GPU_PTR(uint) emission;                    // [emissive voxels] as RGB9E5
    uint voxel_count;
    uint sum_shift;
};
GPU_KERNEL(voxelize, resolve_emission, ResolveEmission, ResolveEmissionParams, GPU_NO_CONSTANTS)

GPU_NAMESPACE_END

#endif
