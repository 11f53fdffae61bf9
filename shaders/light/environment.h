// SPDX-License-Identifier: MIT
// Light from outside of the grid: a map of radiance in all directions, a sun, and the tables by which directions
// towards the map's light are chosen.
//
// A map has width x height texels of linear radiance, row by row from the top: equirectangular, up is its +y, the
// middle of the map is its -z, and +x is a quarter of the width to the right of it. Between the middles of texels
// radiance is linear.
//
// Directions are chosen by cells, which divide the map evenly: a cell by an alias table (A. Walker, 1977), in it a
// direction uniformly by solid angle. There is a table for each of the six normals that faces of voxels have. A cell's
// weight is its mean luminance times its solid angle times the cosine between its directions and the normal, as a
// fraction of the heaviest cell's in kWeightBits bits, but at least one step. Only light/alias_totals rounds it:
// another kernel may round the same expression in another way. All further numbers are integers, so that probabilities
// are the weights' shares exactly.
//
// Alias tables are made in parallel (L. Huebschle-Schneider, P. Sanders, Parallel Weighted Random Sampling, 2019). A
// cell is light if its weight is at most the mean, else heavy. What light cells lack and what heavy cells have too much
// is laid end to end, each in the order of the cells. A light cell is filled up by the heavy one in whose stretch the
// light cell's stretch begins; a heavy cell that has given more than it had is filled up by the next heavy one.
#ifndef ZVO_SHADERS_LIGHT_ENVIRONMENT_H
#define ZVO_SHADERS_LIGHT_ENVIRONMENT_H

#include "light/outside.h"
#include "shared/sky.h"

GPU_NAMESPACE_BEGIN

const uint kAliasGroup = 64u;         // threads of a workgroup
const uint kAliasItems = 16u;         // cells that a thread takes where sums are made
const uint kAliasBlock = 1024u;       // cells of a workgroup there
const uint kAliasCellsMax = 1u << 19; // so that sums have 64 bits
const uint kWeightBits = 24u;
const float kSmallestFloat = 1.17549435e-38f; // normal

/// What the tables of the normals are made of.
struct AliasTotals
{
    uint heaviest[kNormals];    // bits of the largest weight as a float
    uint low_sums[kNormals];    // sum of the lower kWeightBits / 2 bits of all weights, in steps
    uint high_sums[kNormals];   // and of the upper ones
    float irradiance[kNormals]; // luminance that a face with this normal receives of the map
};
GPU_BUFFER(AliasTotals, 4);

/// Sums over cells.
struct AliasSums
{
    uint64_t lacks; // of light cells: what they have less than the mean, times the number of cells
    uint64_t gives; // of heavy cells: what they have more
    uint light_count;
    uint heavy_count;
};
GPU_BUFFER(AliasSums, 8);

/// A cell among the light or the heavy ones of a normal.
struct AliasItem
{
    uint64_t before; // what the cells of its kind before it lack or give
    uint cell;
    uint unused;
};
GPU_BUFFER(AliasItem, 8);

struct EnvironmentGivesParams // push constants of light/environment_gives: a thread a normal
{
    GPU_CONST_PTR(AliasTotals) totals;
    GPU_PTR(vec2) gives; // [kNormals]
    vec3 to_sun;
    vec3 sun;
    float sun_height;
    float strength;
};
GPU_KERNEL(light, environment_gives, EnvironmentGives, EnvironmentGivesParams, GPU_NO_CONSTANTS)

struct SkyTexelsParams // push constants of light/sky_texels: a thread a texel
{
    GPU_PTR(vec3) texels; // [width * height]
    Sky sky;              // in the axes of the map
    uint width;
    uint height;
};
GPU_KERNEL(light, sky_texels, SkyTexels, SkyTexelsParams, GPU_NO_CONSTANTS)

struct AliasWeightsParams // push constants of light/alias_weights: a thread a cell
{
    GPU_CONST_PTR(vec3) texels;
    GPU_PTR(uint) weights; // [kNormals][cells] bits of floats
    GPU_PTR(AliasTotals) totals;
    EnvironmentMap map;
};
#define LIGHT_ALIAS_WEIGHTS_CONSTANTS(CONSTANT) CONSTANT(0, bool, evenly, kEvenly, false) /* by solid angle alone */
GPU_KERNEL(light, alias_weights, AliasWeights, AliasWeightsParams, LIGHT_ALIAS_WEIGHTS_CONSTANTS)

/// Push constants of the other kernels for tables: a workgroup a block of cells of a normal, all blocks of +x first.
struct AliasParams
{
    GPU_PTR(uint) weights; // [kNormals][cells] from alias_totals on in steps
    GPU_PTR(AliasTotals) totals;
    GPU_PTR(AliasSums) sums;  // [kNormals][blocks]
    GPU_PTR(AliasItem) light; // [kNormals][cells]
    GPU_PTR(AliasItem) heavy; // [kNormals][cells]
    GPU_PTR(AliasCell) cells; // [kNormals][cells]
    uint cell_count;
    uint block_count;
};
GPU_KERNEL(light, alias_totals, AliasTotals, AliasParams, GPU_NO_CONSTANTS) // also rounds weights to steps
GPU_KERNEL(light, alias_sums, AliasSums, AliasParams, GPU_NO_CONSTANTS)
GPU_KERNEL(light, alias_scan, AliasScan, AliasParams, GPU_NO_CONSTANTS) // a workgroup a normal
GPU_KERNEL(light, alias_lists, AliasLists, AliasParams, GPU_NO_CONSTANTS)
GPU_KERNEL(light, alias_fill, AliasFill, AliasParams,
           GPU_NO_CONSTANTS) // a thread an item, of a normal's cells first the light ones

GPU_NAMESPACE_END

#endif
