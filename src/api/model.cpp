// SPDX-License-Identifier: MIT
#include "zvo/model.h"

#include "api/checked.h"
#include "api/convert.h"
#include "api/model_impl.h"
#include "core/scene/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <type_traits>

namespace zvo
{

namespace
{

[[noreturn]] void refuse(const std::string& what)
{
    throw Error(ErrorCode::Usage, "a model cannot be uploaded: " + what);
}

template <typename To, typename From> std::vector<To> copied(std::span<const From> values)
{
    static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To>);
    std::vector<To> result(values.size());
    if (!values.empty())
    {
        std::memcpy(result.data(), values.data(), values.size_bytes());
    }
    return result;
}

Image imageOf(const TextureInfo& texture, std::size_t number)
{
    if (texture.width == 0 || texture.height == 0 || texture.rgba.size() / 4 / texture.width != texture.height ||
        texture.rgba.size() != std::uint64_t{4} * texture.width * texture.height)
    {
        refuse(fmt::format("texture {} of {} x {} pixels has {} bytes, not 4 a pixel", number, texture.width,
                           texture.height, texture.rgba.size()));
    }
    return {
        fmt::format("texture {}", number), texture.width, texture.height, {texture.rgba.begin(), texture.rgba.end()}};
}

std::optional<std::uint32_t> textureIndex(std::uint32_t texture, std::size_t count, std::size_t material)
{
    if (texture == kNoTexture)
    {
        return std::nullopt;
    }
    if (texture >= count)
    {
        refuse(fmt::format("material {} has texture {} of {}", material, texture, count));
    }
    return texture;
}

Material materialOf(const MaterialInfo& info, std::size_t texture_count, std::size_t number)
{
    Material material;
    material.name = fmt::format("material {}", number);
    material.base_color = {info.base_color[0], info.base_color[1], info.base_color[2], info.base_color[3]};
    material.base_color_texture = textureIndex(info.base_color_texture, texture_count, number);
    material.emission = toGlm(info.emission);
    material.emission_texture = textureIndex(info.emission_texture, texture_count, number);
    material.alpha_mode = checkedEnum(info.alpha_mode, AlphaMode::Blend, "MaterialInfo::alpha_mode");
    material.alpha_cutoff = info.alpha_cutoff;
    return material;
}

Primitive primitiveOf(const MeshInfo& info, std::size_t material_count, std::size_t number)
{
    const std::size_t vertex_count = info.positions.size();
    if (std::max(vertex_count, info.triangles.size()) > UINT32_MAX) // checked before any element is read
    {
        throw Error(ErrorCode::Input, fmt::format("a model cannot be uploaded: mesh {} has more than 2^32 - 1 vertices "
                                                  "or triangles",
                                                  number));
    }
    for (const std::size_t count : {info.normals.size(), info.uvs.size(), info.colors.size()})
    {
        if (count != 0 && count != vertex_count)
        {
            refuse(fmt::format("mesh {} has {} positions and {} of something else", number, vertex_count, count));
        }
    }
    for (const auto& triangle : info.triangles)
    {
        for (const std::uint32_t vertex : triangle)
        {
            if (vertex >= vertex_count)
            {
                refuse(fmt::format("mesh {} has a triangle with vertex {} of {}", number, vertex, vertex_count));
            }
        }
    }
    if (info.material >= material_count)
    {
        refuse(fmt::format("mesh {} has material {} of {}", number, info.material, material_count));
    }
    Primitive primitive;
    primitive.positions = copied<glm::vec3>(info.positions);
    primitive.normals = copied<glm::vec3>(info.normals);
    primitive.uvs = copied<glm::vec2>(info.uvs);
    primitive.colors = copied<glm::vec4>(info.colors);
    primitive.triangles = copied<glm::uvec3>(info.triangles);
    primitive.material = info.material;
    return primitive;
}

Instance instanceOf(const InstanceInfo& info, std::size_t mesh_count, std::size_t number)
{
    if (info.mesh >= mesh_count)
    {
        refuse(fmt::format("instance {} has mesh {} of {}", number, info.mesh, mesh_count));
    }
    Instance instance;
    instance.primitive = info.mesh;
    instance.transform = toGlm(checkedTransform(info.transform, fmt::format("instance {}", number)));
    return instance;
}

Scene sceneOf(const ModelInfo& info)
{
    Scene scene;
    for (std::size_t i = 0; i < info.textures.size(); ++i)
    {
        const TextureInfo& texture = info.textures[i];
        scene.images.push_back(imageOf(texture, i));
        scene.textures.push_back({static_cast<std::uint32_t>(i),
                                  checkedEnum(texture.wrap_u, WrapMode::ClampToEdge, "TextureInfo::wrap_u"),
                                  checkedEnum(texture.wrap_v, WrapMode::ClampToEdge, "TextureInfo::wrap_v")});
    }
    for (std::size_t i = 0; i < info.materials.size(); ++i)
    {
        scene.materials.push_back(materialOf(info.materials[i], info.textures.size(), i));
    }
    if (scene.materials.empty())
    {
        scene.materials.emplace_back();
    }
    for (std::size_t i = 0; i < info.meshes.size(); ++i)
    {
        scene.primitives.push_back(primitiveOf(info.meshes[i], scene.materials.size(), i));
        if (info.instances.empty())
        {
            scene.instances.push_back({.primitive = static_cast<std::uint32_t>(i)});
        }
    }
    for (std::size_t i = 0; i < info.instances.size(); ++i)
    {
        scene.instances.push_back(instanceOf(info.instances[i], info.meshes.size(), i));
    }
    return scene;
}

} // namespace

Model::Model(Recorder& recorder, const ModelInfo& info)
{
    Scene scene = sceneOf(info);
    m_impl = std::make_shared<Impl>(recorder.impl().context, recorder.impl().frame);
    m_impl->bounds = scene.bounds();
    const float scale = checkedAmount(info.emission_scale.value_or(info.attributes ? brightestEmission(scene) : 0.0F),
                                      "the emission scale");
    recording(recorder, [&](Recorder::Impl& impl)
              { m_impl->mesh = uploadDynamicMesh(impl.context.uploads, std::move(scene), info.attributes, scale); });
}

Model::~Model() = default;
Model::Model(const Model&) = default;
Model& Model::operator=(const Model&) = default;

std::uint64_t Model::triangleCount() const
{
    return usable(*this).mesh->uploaded.triangle_count;
}

float Model::emissionScale() const
{
    return usable(*this).mesh->uploaded.emission_scale;
}

GridInfo Model::gridAround(std::uint32_t depth) const
{
    if (depth < 1 || depth > Grid::kDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("a grid has a depth from 1 to {}, not {}", Grid::kDepthMax, depth));
    }
    return gridInfo(Grid::around(usable(*this).bounds, depth));
}

} // namespace zvo
