// SPDX-License-Identifier: MIT
// The surface of a triangle, and the attributes of its fragments, in integers (docs/voxelization.md).
// Needs EDGE_INT, EDGE_IVEC3 and EDGE_WIDE as voxelize/raster.glsl does, the constants kMaterialClass, kEmits and
// kMode, and params.scene.
#ifndef ZVO_SHADERS_VOXELIZE_SHADING_GLSL
#define ZVO_SHADERS_VOXELIZE_SHADING_GLSL

#include "lib/arithmetic.glsl"
#include "lib/attribute.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/vertex.glsl"
#include "voxelize/voxelize.h"

#ifndef EDGE_IVEC3
#error "voxelize/shading.glsl needs EDGE_IVEC3: ivec3 or i64vec3"
#endif

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
    TextureLevel level; // the level of detail that suits the triangle
    bool textured;
    TriangleUvs emission_uvs;
    TextureInfo emission_texture;
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
uvec3 fixedWeights(EDGE_IVEC3 corners, bool has_area)
{
    EDGE_IVEC3 b = max(corners, EDGE_IVEC3(0));
#ifdef EDGE_WIDE
    u64vec3 wide = u64vec3(b);
    uint64_t total = wide.x + wide.y + wide.z;
    uvec2 words = unpack32(total);
    int top = words.y != 0u ? 32 + findMSB(words.y) : findMSB(words.x);
    int shift = max(top - 15, 0);
    uvec3 small = uvec3(wide >> shift);
    uint sum = uint(total >> shift);
#else
    uvec3 narrow = uvec3(b);
    uint total = narrow.x + narrow.y + narrow.z;
    int shift = max(findMSB(total) - 15, 0);
    uvec3 small = narrow >> shift;
    uint sum = total >> shift;
#endif
    sum = max(sum, 1u);
    uvec2 w = divideSmall(small.xy * kUvOne, sum);
    return has_area ? uvec3(w, kUvOne - w.x - w.y) : uvec3(21846u, 21845u, 21845u);
}

// The smallest level whose texels are about as large as voxels. double_area: of the triangle, in lattice units squared.
TextureLevel pickLevel(TextureInfo info, TriangleUvs uvs, float double_area)
{
    i64vec2 d1 = i64vec2(uvs.u.y - uvs.u.x, uvs.v.y - uvs.v.x);
    i64vec2 d2 = i64vec2(uvs.u.z - uvs.u.x, uvs.v.z - uvs.v.x);
    float uv_area = float(abs(d1.x * d2.y - d2.x * d1.y));
    TextureLevel level = loadLevel(info.first_level);
    precise float texels = uv_area * (float(level.width * level.height) * (1.0 / float(kUvOne)));
    uint level_count = info.level_range & ((1u << kLeastLevelShift) - 1u);
    uint l = info.level_range >> kLeastLevelShift; // no triangle of the scene asks for a level before it
    float budget = double_area * 2.0 * float(1u << (2u * l));
    for (; l + 1u < level_count && texels > budget; ++l)
        budget *= 4.0;
    return loadLevel(info.first_level + l);
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

TriangleUvs loadUvs(uint first, uvec3 vertices)
{
    ivec2 uv0 = loadUv(first + vertices.x);
    ivec2 uv1 = loadUv(first + vertices.y);
    ivec2 uv2 = loadUv(first + vertices.z);
    return TriangleUvs(ivec3(uv0.x, uv1.x, uv2.x), ivec3(uv0.y, uv1.y, uv2.y));
}

// vertices: indices within the draw. normal: of the lattice points, by winding; corner_area: |n_w|.
Surface loadSurface(Draw draw, uvec3 vertices, vec3 normal, float corner_area)
{
    Surface surface;
    Material material = loadMaterial(draw.material);
    surface.alpha_mode = material.alpha_mode;
    surface.alpha_cutoff = material.alpha_cutoff;
    surface.factor = unpackFractions(material.base_color);
    surface.emission = unpackFractions(material.emission).rgb;
    surface.texels = SCENE_TEXELS;
    surface.linear_table = LINEAR_TABLE(params.scene);
    const bool may_have_textures = kMaterialClass != kClassPlain;
    surface.textured = may_have_textures && draw.first_uv != kAbsent && material.base_texture != kAbsent;
    surface.emission_textured = kEmits && may_have_textures && kMode != kModeCoverage &&
                                draw.first_emission_uv != kAbsent && material.emission_texture != kAbsent;
    if (surface.textured)
    {
        surface.uvs = loadUvs(draw.first_uv, vertices);
        surface.texture = loadTexture(material.base_texture);
        surface.level = pickLevel(surface.texture, surface.uvs, corner_area);
    }
    if (surface.emission_textured)
    {
        surface.emission_uvs = loadUvs(draw.first_emission_uv, vertices);
        surface.emission_texture = loadTexture(material.emission_texture);
        surface.emission_level = pickLevel(surface.emission_texture, surface.emission_uvs, corner_area);
    }
    surface.colored = draw.first_color != kAbsent;
    if (surface.colored)
        for (uint i = 0u; i < 3u; ++i)
            surface.colors[i] = loadColor(draw.first_color + vertices[i]);
    if (kMode == kModeAttributes)
    {
        ivec3 flat_normal = unitNormal(draw.mirrored != 0u ? -normal : normal);
        for (uint i = 0u; i < 3u; ++i)
        {
            surface.normals[i] = flat_normal;
            if (draw.first_normal != kAbsent)
            {
                vec3 normal = loadNormal(draw.first_normal + vertices[i]);
                bool turned = floatBitsToUint(normal.x) == kTurnedRoundBits;
                ivec3 vertex_normal = unitNormal(worldNormal(draw, normal));
                if (vertex_normal == ivec3(0))
                    vertex_normal = turned ? -flat_normal : flat_normal;
                surface.normals[i] = vertex_normal;
            }
        }
    }
    return surface;
}

#endif
