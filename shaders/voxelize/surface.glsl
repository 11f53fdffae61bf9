// SPDX-License-Identifier: MIT
// The surface of a triangle from its vertices, for kernels that walk triangles.
// Needs what voxelize/shading.glsl and voxelize/vertex.glsl need.
#ifndef ZVO_SHADERS_VOXELIZE_SURFACE_GLSL
#define ZVO_SHADERS_VOXELIZE_SURFACE_GLSL

#include "voxelize/shading.glsl"
#include "voxelize/vertex.glsl"

// The number of the smallest level whose texels are about as large as voxels. double_area: of the triangle, in lattice
// units squared.
uint pickLevel(TextureInfo info, TriangleUvs uvs, float double_area)
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
    return info.first_level + l;
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
        surface.level_number = pickLevel(surface.texture, surface.uvs, corner_area);
        surface.level = loadLevel(surface.level_number);
    }
    if (surface.emission_textured)
    {
        surface.emission_uvs = loadUvs(draw.first_emission_uv, vertices);
        surface.emission_texture = loadTexture(material.emission_texture);
        surface.emission_level_number = pickLevel(surface.emission_texture, surface.emission_uvs, corner_area);
        surface.emission_level = loadLevel(surface.emission_level_number);
    }
    surface.colored = draw.first_color != kAbsent;
    if (surface.colored)
        for (uint i = 0u; i < 3u; ++i)
            surface.colors[i] = loadColor(draw.first_color + vertices[i]);
    if (kMode == kModeAttributes)
    {
        bool has_side = draw.is_points == 0u; // a point without a normal has none
        ivec3 flat_normal = has_side ? unitNormal(draw.mirrored != 0u ? -normal : normal) : ivec3(0);
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
