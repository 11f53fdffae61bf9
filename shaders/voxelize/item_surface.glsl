// SPDX-License-Identifier: MIT
// The surface of a triangle from its setup, for fragments.
// Needs what voxelize/setup.glsl and voxelize/shading.glsl need.
#ifndef ZVO_SHADERS_VOXELIZE_ITEM_SURFACE_GLSL
#define ZVO_SHADERS_VOXELIZE_ITEM_SURFACE_GLSL

#include "voxelize/setup.glsl"
#include "voxelize/shading.glsl"

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
