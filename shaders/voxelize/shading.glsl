// SPDX-License-Identifier: MIT
// The attributes of the fragments of a triangle, in integers (docs/voxelization.md).
// Needs the constants kMaterialClass, kEmits and kMode, and params.scene.
#ifndef ZVO_SHADERS_VOXELIZE_SHADING_GLSL
#define ZVO_SHADERS_VOXELIZE_SHADING_GLSL

#include "lib/arithmetic.glsl"
#include "lib/attribute.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/voxelize.h"

// Texture coordinates of the three vertices of a triangle, 16.16.
struct TriangleUvs
{
    ivec3 u;
    ivec3 v;
};

// Per triangle, fetched once before the walk.
struct Surface
{
    uint alpha_mode;
    uint alpha_cutoff;
    SceneTexels texels;
    LinearTable linear_table; // of the texels' colours
    TriangleUvs uvs;
    TextureInfo texture;
    uint level_number;  // of level, in SceneView::levels
    TextureLevel level; // the level of detail that suits the triangle
    bool textured;
    TriangleUvs emission_uvs;
    TextureInfo emission_texture;
    uint emission_level_number;
    TextureLevel emission_level;
    bool emission_textured;
    uvec4 factor; // base colour, 16-bit fractions
    uvec3 emission;
    uvec2 colors[3]; // vertex colours, packed
    bool colored;
    ivec3 normals[3]; // length 32767
};

uvec4 unpackFractions(uvec2 packed)
{
    return uvec4(packed.x & kFractionOne, packed.x >> 16, packed.y & kFractionOne, packed.y >> 16);
}

// The rounded product of two 16-bit fractions.
uint mul16(uint a, uint b)
{
    uint t = a * b + 32768u;
    return (t + (t >> 16)) >> 16;
}

uvec3 mul16(uvec3 a, uvec3 b)
{
    uvec3 t = a * b + 32768u;
    return (t + (t >> 16)) >> 16;
}

// Barycentric weights in 1/65536 that add up to 65536. has_area: the triangle is not a segment or a point.
uvec3 fixedWeights(i64vec3 corners, bool has_area)
{
    u64vec3 wide = u64vec3(max(corners, i64vec3(0)));
    uint64_t total = wide.x + wide.y + wide.z;
    uvec2 words = unpack32(total);
    int top = words.y != 0u ? 32 + findMSB(words.y) : findMSB(words.x);
    int shift = max(top - 15, 0);
    uvec3 small = uvec3(wide >> shift);
    uint sum = max(uint(total >> shift), 1u);
    uvec2 w = divideSmall(small.xy * kUvOne, sum);
    return has_area ? uvec3(w, kUvOne - w.x - w.y) : uvec3(21846u, 21845u, 21845u);
}

// Texel numbers and weight of the second one along an axis.
uvec3 texelPair(int64_t coordinate, uint size, uint wrap)
{
    const int64_t one = int64_t(kUvOne);
    int repeated = int(coordinate & (one - 1));
    int twice = int(coordinate & (2 * one - 1));
    int mirrored = twice > int(kUvOne) ? 2 * int(kUvOne) - twice : twice;
    int clamped = int(clamp(coordinate, int64_t(0), one));
    int inside = wrap == kWrapRepeat ? repeated : (wrap == kWrapMirror ? mirrored : clamped);
    int x = inside * int(size) - int(kUvOne / 2u);
    int first = x >> 16;
    int last = int(size) - 1;
    int second = first + 1;
    bool repeat = wrap == kWrapRepeat;
    second = second > last ? (repeat ? 0 : last) : second;
    first = first < 0 ? (repeat ? last : 0) : first;
    return uvec3(first, second, (x >> 8) & 255);
}

// Linear colour as 16-bit fractions, and 8-bit alpha.
uvec4 linearTexel(Surface surface, uint i)
{
    uint texel = loadTexel(surface.texels, i);
    return uvec4(linearColor(surface.linear_table, texel), texel >> 24);
}

// Linear colour and alpha as 16-bit fractions, filtered bilinearly.
uvec4 sampleTexture(Surface surface, TriangleUvs uvs, TextureInfo info, TextureLevel level, uvec3 weights)
{
    i64vec3 w = i64vec3(weights);
    i64vec3 by_u = w * i64vec3(uvs.u);
    i64vec3 by_v = w * i64vec3(uvs.v);
    uvec3 x = texelPair((by_u.x + by_u.y + by_u.z) >> 16, level.width, info.wrap_u);
    uvec3 y = texelPair((by_v.x + by_v.y + by_v.z) >> 16, level.height, info.wrap_v);
    uvec2 wx = uvec2(256u - x.z, x.z);
    uvec2 wy = uvec2(256u - y.z, y.z);
    uvec2 row = level.first_texel + y.xy * level.width;
    uvec4 sum = linearTexel(surface, row.x + x.x) * (wx.x * wy.x) +
                linearTexel(surface, row.x + x.y) * (wx.y * wy.x) +
                linearTexel(surface, row.y + x.x) * (wx.x * wy.y) +
                linearTexel(surface, row.y + x.y) * (wx.y * wy.y);
    return (uvec4(sum.rgb, sum.a * 257u) + 32768u) >> 16;
}

// Base colour and alpha.
uvec4 fragmentColor(Surface surface, uvec3 weights)
{
    uvec4 color = uvec4(kFractionOne);
    if (kMaterialClass != kClassPlain && surface.textured)
        color = sampleTexture(surface, surface.uvs, surface.texture, surface.level, weights);
    color = uvec4(mul16(color.rgb, surface.factor.rgb), mul16(color.a, surface.factor.a));
    if (surface.colored)
    {
        uvec4 vertex = (unpackFractions(surface.colors[0]) * weights.x +
                        unpackFractions(surface.colors[1]) * weights.y +
                        unpackFractions(surface.colors[2]) * weights.z) >> 16;
        color = uvec4(mul16(color.rgb, vertex.rgb), mul16(color.a, vertex.a));
    }
    return color;
}

// Rank 0 .. 63 of a voxel in the ordered dither of blended surfaces.
uint ditherRank(uvec3 voxel)
{
    uvec3 mixed = uvec3(voxel.x, voxel.x ^ voxel.y, voxel.y ^ voxel.z);
    uvec3 low = mixed & 1u;
    uvec3 high = (mixed >> 1) & 1u;
    return low.x << 5 | low.y << 4 | low.z << 3 | high.x << 2 | high.y << 1 | high.z;
}

// Whether the fragment exists.
bool passesAlpha(Surface surface, uint alpha, uvec3 voxel)
{
    uint threshold =
        surface.alpha_mode == kAlphaMask ? surface.alpha_cutoff : 1024u * ditherRank(voxel) + 512u;
    return surface.alpha_mode == kAlphaOpaque || alpha >= threshold;
}

// Interpolated normal, not longer than 32767.
ivec3 fragmentNormal(Surface surface, uvec3 weights)
{
    ivec3 w = ivec3(weights);
    return (surface.normals[0] * w.x + surface.normals[1] * w.y + surface.normals[2] * w.z) >> 16;
}

// Emission as 16-bit fractions of the scene's brightest one.
uvec3 fragmentEmission(Surface surface, uvec3 weights)
{
    uvec3 emission = surface.emission;
    if (kMaterialClass != kClassPlain && surface.emission_textured)
    {
        uvec4 texel = sampleTexture(surface, surface.emission_uvs, surface.emission_texture, surface.emission_level,
                                    weights);
        emission = mul16(emission, texel.rgb);
    }
    return emission;
}

#endif
