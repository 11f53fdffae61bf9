// SPDX-License-Identifier: MIT
// A scene in device memory: draws of triangle lists, materials, and textures in one pool. Written once, then only read.
#ifndef ZVO_SHADERS_SHARED_SCENE_H
#define ZVO_SHADERS_SHARED_SCENE_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

const uint kAbsent = ~0u; // in place of an index: there is none

const uint kAlphaOpaque = 0u;
const uint kAlphaMask = 1u;
const uint kAlphaBlend = 2u;

const uint kWrapRepeat = 0u;
const uint kWrapMirror = 1u;
const uint kWrapClamp = 2u;

const uint kUvOne = 65536u;       // a texture coordinate of 1
const uint kUvLimit = 8192u;      // texture coordinates beyond +-kUvLimit are clamped
const uint kFractionOne = 65535u; // 1 as a 16-bit fraction: colours, factors, alpha

// A normal is a direction if the biased exponent of its largest component is in this range, 2^-99 to 2^100. A vertex
// with any other normal has none and takes that of its triangle; turned round if the normal's x has the bits of
// -2^-120.
const uint kDirectionExponentMin = 28u;
const uint kDirectionExponentMax = 226u;
const uint kTurnedRoundBits = 2206203904u;

/// One instance of a list of triangles or points.
struct Draw
{
    mat4x3 transform;      // object to world
    mat3 normal_transform; // cofactors of the linear part, times the sign of its determinant
    uint first_triangle;   // in SceneView::triangles
    uint triangle_count;
    uint first_vertex; // in SceneView::positions; the triangles' indices count from here
    uint first_normal; // in SceneView::normals, or kAbsent
    uint first_uv;     // in SceneView::uvs, or kAbsent
    uint first_color;  // in SceneView::colors, or kAbsent
    uint material;
    uint mirrored;          // 1: the transform turns the winding around
    uint first_emission_uv; // in SceneView::uvs, or kAbsent: first_uv where emission has the same coordinates
    uint is_points;         // 1: each triangle is a point, three times the same vertex
    uint point_shift;       // of a point on the lattice, in half voxels: signed, 8 bits for each of x, y and z
};
GPU_BUFFER(Draw, 4);

const uint kDrawWords = 32u; // 32-bit words of a Draw

struct Material
{
    uvec2 base_color;      // linear r | g << 16, b | a << 16 as 16-bit fractions
    uvec2 emission;        // r | g << 16, b as 16-bit fractions of the scene's brightest emission
    uint base_texture;     // kAbsent or index
    uint emission_texture; // kAbsent or index
    uint alpha_mode;
    uint alpha_cutoff; // 16-bit fraction; above kFractionOne: never reached
};
GPU_BUFFER(Material, 4);

const uint kLeastLevelShift = 16u; // of TextureInfo::level_range

struct TextureInfo
{
    uint first_level; // in SceneView::levels
    uint level_range; // number of levels | the first one that is stored << kLeastLevelShift
    uint wrap_u;
    uint wrap_v;
};
GPU_BUFFER(TextureInfo, 4);

struct TextureLevel
{
    uint first_texel; // in SceneView::texels; kAbsent where the level is not stored
    uint width;
    uint height;
};
GPU_BUFFER(TextureLevel, 4);

/// The addresses of all buffers of a scene. Kernels get the address of this table.
struct SceneView
{
    GPU_CONST_PTR(Draw) draws;
    GPU_CONST_PTR(uvec3) triangles;
    GPU_CONST_PTR(vec3) positions;
    GPU_CONST_PTR(vec3) normals;
    GPU_CONST_PTR(ivec2) uvs;    // 16.16 fixed point
    GPU_CONST_PTR(uvec2) colors; // linear r | g << 16, b | a << 16 as 16-bit fractions
    GPU_CONST_PTR(Material) materials;
    GPU_CONST_PTR(TextureInfo) textures;
    GPU_CONST_PTR(TextureLevel) levels;
    GPU_CONST_PTR(uint) texels;         // r | g << 8 | b << 16 | alpha << 24, 8 bits each; colour as sRGB codes
    GPU_CONST_PTR(uint) srgb_to_linear; // [256] 8-bit sRGB to linear 16-bit fraction
    GPU_CONST_PTR(uint) linear_to_srgb; // [16384] linear 16-bit fraction to 8-bit sRGB, four a word
};
GPU_BUFFER(SceneView, 8);

GPU_NAMESPACE_END

#endif
