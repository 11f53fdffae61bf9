// SPDX-License-Identifier: MIT
// The surface of a triangle from its setup, for fragments.
// Needs what voxelize/setup.glsl and voxelize/shading.glsl need, and params.surfaces.
// SETUPS_BINDING (optional): the next one is that of params.surfaces in the kernel's bound form (lib/bound.glsl).
#ifndef ZVO_SHADERS_VOXELIZE_ITEM_SURFACE_GLSL
#define ZVO_SHADERS_VOXELIZE_ITEM_SURFACE_GLSL

#include "voxelize/setup.glsl"
#include "voxelize/shading.glsl"

#if defined(BOUND) && defined(SETUPS_BINDING)
TEXELS_4(SETUPS_BINDING + 1, surfaces);
#define SURFACE_WORDS(I) texelFetch(texels4_surfaces, int(I))
#else
#define SURFACE_WORDS(I) uvec4_ConstPtr(uint64_t(params.surfaces)).data[I]
#endif

SurfaceSetup loadSurfaceSetup(uint i)
{
    uvec4 a = SURFACE_WORDS(4u * i);
    uvec4 b = SURFACE_WORDS(4u * i + 1u);
    uvec4 c = SURFACE_WORDS(4u * i + 2u);
    uvec4 d = SURFACE_WORDS(4u * i + 3u);
    return SurfaceSetup(ivec3(a.xyz), ivec3(a.w, b.xy), b.z, uvec4(b.w, c.xyz), uvec2(c.w, d.x), d.yzw);
}

Surface surfaceOf(uint triangle, TriangleSetup setup)
{
    Surface surface;
    Material material = loadMaterial(setup.material);
    surface.alpha_mode = material.alpha_mode;
    surface.alpha_cutoff = material.alpha_cutoff;
    surface.factor = unpackFractions(material.base_color);
    surface.texels = SCENE_TEXELS;
    surface.linear_table = LINEAR_TABLE(params.scene);
    surface.textured = kMaterialClass != kClassPlain && hasFlag(setup, kSetupTextured);
    surface.colored = hasFlag(setup, kSetupColored);
    if (surface.textured || surface.colored)
    {
        SurfaceSetup more = loadSurfaceSetup(triangle);
        surface.colors[0] = more.colors.xy;
        surface.colors[1] = more.colors.zw;
        surface.colors[2] = more.color_2;
        surface.uvs = TriangleUvs(more.uv_u, more.uv_v);
        surface.texture.wrap_u = bitfieldExtract(setup.flags, int(kSetupWrapU), 2);
        surface.texture.wrap_v = bitfieldExtract(setup.flags, int(kSetupWrapV), 2);
        if (surface.textured)
            surface.level = loadLevel(more.level);
    }
    unpackNormals(setup, surface.normals);
    return surface;
}

#endif
