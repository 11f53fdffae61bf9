// SPDX-License-Identifier: MIT
#include "support/host_model.h"

#include <span>
#include <utility>

namespace zvo::test
{

namespace
{

template <typename To, typename From> std::span<const To> viewed(const std::vector<From>& values)
{
    static_assert(sizeof(To) == sizeof(From));
    return {reinterpret_cast<const To*>(values.data()), values.size()};
}

} // namespace

HostModel::HostModel(Scene described) : m_scene(std::move(described))
{
    const Scene& scene = m_scene;
    for (const Texture& texture : scene.textures)
    {
        const Image& image = scene.images[texture.image];
        m_textures.push_back({image.width, image.height, image.rgba, texture.wrap_u, texture.wrap_v});
    }
    for (const Material& material : scene.materials)
    {
        const glm::vec4& color = material.base_color;
        const glm::vec3& emission = material.emission;
        m_materials.push_back({{color.r, color.g, color.b, color.a},
                               material.base_color_texture.value_or(kNoTexture),
                               {emission.r, emission.g, emission.b},
                               material.emission_texture.value_or(kNoTexture),
                               material.alpha_mode,
                               material.alpha_cutoff});
    }
    for (const Primitive& primitive : scene.primitives)
    {
        m_meshes.push_back({viewed<Vec3>(primitive.positions), viewed<Vec3>(primitive.normals),
                            viewed<Vec2>(primitive.uvs), viewed<Vec4>(primitive.colors),
                            viewed<std::array<std::uint32_t, 3>>(primitive.triangles), primitive.material});
    }
    for (const Instance& instance : scene.instances)
    {
        InstanceInfo info;
        info.mesh = instance.primitive;
        for (int i = 0; i < 16; ++i)
        {
            info.transform[static_cast<std::size_t>(i)] = instance.transform[i / 4][i % 4];
        }
        m_instances.push_back(info);
    }
}

ModelInfo HostModel::info() const
{
    ModelInfo info;
    info.meshes = m_meshes;
    info.instances = m_instances;
    info.materials = m_materials;
    info.textures = m_textures;
    return info;
}

} // namespace zvo::test
