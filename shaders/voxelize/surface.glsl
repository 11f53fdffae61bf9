// SPDX-License-Identifier: MIT
// Loads the data of a triangle that its fragments need.

// vertices: indices within the draw. normal: of the lattice points, by winding; corner_area: |n_w|.
Surface loadSurface(Draw draw, uvec3 vertices, vec3 normal, float corner_area)
{
    Surface surface;
    Material material = loadMaterial(draw.material);
    surface.alpha_mode = material.alpha_mode;
    surface.alpha_cutoff = material.alpha_cutoff;
    surface.factor = unpackFractions(material.base_color);
    surface.emission = unpackFractions(material.emission).rgb;
    bool has_uv = kMaterialClass != kClassPlain && draw.first_uv != kAbsent;
    surface.texels = SCENE_TEXELS;
    surface.linear_table = LINEAR_TABLE(params.scene);
    surface.textured = has_uv && material.base_texture != kAbsent;
    surface.emission_textured = kEmits && has_uv && kMode != kModeCoverage && material.emission_texture != kAbsent;
    if (has_uv)
    {
        ivec2 uv0 = loadUv(draw.first_uv + vertices.x);
        ivec2 uv1 = loadUv(draw.first_uv + vertices.y);
        ivec2 uv2 = loadUv(draw.first_uv + vertices.z);
        surface.uv_u = ivec3(uv0.x, uv1.x, uv2.x);
        surface.uv_v = ivec3(uv0.y, uv1.y, uv2.y);
    }
    if (surface.textured)
    {
        surface.texture = loadTexture(material.base_texture);
        surface.level = pickLevel(surface.texture, surface.uv_u, surface.uv_v, corner_area);
    }
    if (surface.emission_textured)
    {
        surface.emission_texture = loadTexture(material.emission_texture);
        surface.emission_level = pickLevel(surface.emission_texture, surface.uv_u, surface.uv_v, corner_area);
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
