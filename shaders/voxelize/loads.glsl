// SPDX-License-Identifier: MIT
// What voxelization loads of a scene: by address, or, in a kernel's bound form (lib/bound.glsl), from texels. Bindings
// 0 to 2 are those of lib/bricks.glsl, voxelize/sums.glsl and cover.comp, 13 and 14 those of voxelize/item.glsl,
// cover.comp and attributes.glsl, 15 and 16 those of lib/attribute.glsl, from 17 on those of setups, and of items or of
// leaves. A kernel has 15 texel buffers at most; Vulkan promises 16.
// Needs params.scene.
#ifndef ZVO_SHADERS_VOXELIZE_LOADS_GLSL
#define ZVO_SHADERS_VOXELIZE_LOADS_GLSL

#include "lib/bound.glsl"
#include "shared/scene.h"

#ifdef BOUND

TEXELS_4(3, draws);
TEXELS_3(4, triangles);
TEXELS_3(5, positions);
TEXELS_3(6, normals);
TEXELS_2(7, uvs);
TEXELS_2(8, colors);
TEXELS_4(9, materials);
TEXELS_4(10, textures);
TEXELS_3(11, levels);
TEXELS_1(12, texels);

#define SceneTexels uint // stands for an address that this form does not need
#define SCENE_TEXELS 0u

Draw loadDraw(uint number)
{
    int first = int(number * (kDrawWords / 4u));
    vec4 a = uintBitsToFloat(texelFetch(texels4_draws, first));
    vec4 b = uintBitsToFloat(texelFetch(texels4_draws, first + 1));
    vec4 c = uintBitsToFloat(texelFetch(texels4_draws, first + 2));
    vec4 d = uintBitsToFloat(texelFetch(texels4_draws, first + 3));
    vec4 e = uintBitsToFloat(texelFetch(texels4_draws, first + 4));
    uvec4 f = texelFetch(texels4_draws, first + 5);
    uvec4 g = texelFetch(texels4_draws, first + 6);
    uvec4 h = texelFetch(texels4_draws, first + 7);
    return Draw(mat4x3(a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw),
                mat3(d.xyz, vec3(d.w, e.xy), vec3(e.zw, uintBitsToFloat(f.x))), f.y, f.z, f.w, g.x, g.y, g.z, g.w, h.x,
                h.y, h.z, h.w);
}

uvec3 loadTriangle(uint i)
{
    return texelFetch(texels3_triangles, int(i)).xyz;
}

vec3 loadPosition(uint i)
{
    return uintBitsToFloat(texelFetch(texels3_positions, int(i)).xyz);
}

vec3 loadNormal(uint i)
{
    return uintBitsToFloat(texelFetch(texels3_normals, int(i)).xyz);
}

ivec2 loadUv(uint i)
{
    return ivec2(texelFetch(texels2_uvs, int(i)).xy);
}

uvec2 loadColor(uint i)
{
    return texelFetch(texels2_colors, int(i)).xy;
}

Material loadMaterial(uint i)
{
    uvec4 factors = texelFetch(texels4_materials, int(2u * i));
    uvec4 rest = texelFetch(texels4_materials, int(2u * i + 1u));
    return Material(factors.xy, factors.zw, rest.x, rest.y, rest.z, rest.w);
}

TextureInfo loadTexture(uint i)
{
    uvec4 words = texelFetch(texels4_textures, int(i));
    return TextureInfo(words.x, words.y, words.z, words.w);
}

TextureLevel loadLevel(uint i)
{
    uvec3 words = texelFetch(texels3_levels, int(i)).xyz;
    return TextureLevel(words.x, words.y, words.z);
}

uint loadTexel(SceneTexels texels, uint i)
{
    return texelFetch(texels1_texels, int(i)).x;
}

#else

// For loadTexel(). To be read before a loop: in it, the address would be loaded each time.
#define SceneTexels uint_ConstPtr
#define SCENE_TEXELS params.scene.data[0].texels

Draw loadDraw(uint number)
{
    return params.scene.data[0].draws.data[number];
}

uvec3 loadTriangle(uint i)
{
    return params.scene.data[0].triangles.data[i];
}

vec3 loadPosition(uint i)
{
    return params.scene.data[0].positions.data[i];
}

vec3 loadNormal(uint i)
{
    return params.scene.data[0].normals.data[i];
}

ivec2 loadUv(uint i)
{
    return params.scene.data[0].uvs.data[i];
}

uvec2 loadColor(uint i)
{
    return params.scene.data[0].colors.data[i];
}

Material loadMaterial(uint i)
{
    return params.scene.data[0].materials.data[i];
}

TextureInfo loadTexture(uint i)
{
    return params.scene.data[0].textures.data[i];
}

TextureLevel loadLevel(uint i)
{
    return params.scene.data[0].levels.data[i];
}

uint loadTexel(SceneTexels texels, uint i)
{
    return texels.data[i];
}

#endif

#endif
