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

// i: of the setups, or where the scene emits light, of twice as many.
SurfaceSetup loadSurfaceSetup(uint i)
{
    uvec4 a = SURFACE_WORDS(4u * i);
    uvec4 b = SURFACE_WORDS(4u * i + 1u);
    uvec4 c = SURFACE_WORDS(4u * i + 2u);
    uvec4 d = SURFACE_WORDS(4u * i + 3u);
    return SurfaceSetup(ivec3(a.xyz), ivec3(a.w, b.xy), b.z, uvec4(b.w, c.xyz), uvec2(c.w, d.x), d.yzw);
}

uint wrapIn(TriangleSetup setup, uint first_bit)
{
    return bitfieldExtract(setup.flags, int(first_bit), 2);
}

// The weights of the vertices in a fragment.
uvec3 weightsAt(TriangleSetup setup, ivec3 voxel)
{
    return fixedWeights(cornersAt(setup, voxel), kThin || !hasFlag(setup, kSetupFlat));
}

Surface surfaceOf(uint triangle, TriangleSetup setup)
{
    Surface surface;
    Material material = loadMaterial(setup.material);
    surface.alpha_mode = material.alpha_mode;
    surface.alpha_cutoff = material.alpha_cutoff;
    surface.factor = unpackFractions(material.base_color);
    surface.emission = unpackFractions(material.emission).rgb;
    surface.texels = SCENE_TEXELS;
    surface.linear_table = LINEAR_TABLE(params.scene);
    surface.textured = kMaterialClass != kClassPlain && hasFlag(setup, kSetupTextured);
    surface.emission_textured = kEmits && kMaterialClass != kClassPlain && hasFlag(setup, kSetupEmissionTextured);
    surface.colored = hasFlag(setup, kSetupColored);
    if (surface.textured || surface.colored)
    {
        SurfaceSetup more = loadSurfaceSetup(kSurfacesOfTriangle * triangle);
        surface.colors[0] = more.colors.xy;
        surface.colors[1] = more.colors.zw;
        surface.colors[2] = more.color_2;
        surface.uvs = TriangleUvs(more.uv_u, more.uv_v);
        surface.texture.wrap_u = wrapIn(setup, kSetupWrapU);
        surface.texture.wrap_v = wrapIn(setup, kSetupWrapV);
        if (surface.textured)
            surface.level = loadLevel(more.level);
    }
    if (surface.emission_textured)
    {
        SurfaceSetup more = loadSurfaceSetup(kSurfacesOfTriangle * triangle + 1u);
        surface.emission_uvs = TriangleUvs(more.uv_u, more.uv_v);
        surface.emission_texture.wrap_u = wrapIn(setup, kSetupEmissionWrapU);
        surface.emission_texture.wrap_v = wrapIn(setup, kSetupEmissionWrapV);
        surface.emission_level = loadLevel(more.level);
    }
    unpackNormals(setup, surface.normals);
    return surface;
}

#endif
