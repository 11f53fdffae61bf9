// SPDX-License-Identifier: MIT
#include "io/mesh/mesh_scene.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/scene/points.h"
#include "io/file/folder_bounds.h"

#include <algorithm>
#include <fmt/format.h>
#include <system_error>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

std::filesystem::path folderOf(const std::filesystem::path& file)
{
    return file.has_parent_path() ? file.parent_path() : ".";
}

} // namespace

std::optional<std::filesystem::path> findBeside(const std::filesystem::path& mesh,
                                                const std::filesystem::path& named_in, std::string name)
{
    std::ranges::replace(name, '\\', '/');
    for (const std::string& candidate : {name, name.substr(name.rfind('/') + 1)})
    {
        for (const std::filesystem::path& folder : {folderOf(mesh), folderOf(named_in)})
        {
            std::error_code absent;
            const std::filesystem::path file = folder / candidate;
            if (liesBelow(folderOf(mesh), file) && std::filesystem::is_regular_file(file, absent))
            {
                return file;
            }
        }
    }
    return std::nullopt;
}

void MeshScene::warn(const std::string& kind, std::string_view first)
{
    if (m_warned.insert(kind).second)
    {
        m_scene.warnings.emplace_back(inputError(m_path, fmt::format("{}{}", kind, first)).what());
    }
}

void MeshScene::add(Primitive primitive, Material material, const std::string& name)
{
    material.name = name;
    const auto index = static_cast<std::uint32_t>(m_scene.primitives.size());
    primitive.material = index;
    m_scene.instances.push_back({.primitive = index});
    m_scene.primitives.push_back(std::move(primitive));
    m_scene.materials.push_back(std::move(material));
}

std::optional<std::uint32_t> MeshScene::addTexture(const std::string& name, const std::filesystem::path& named_in,
                                                   WrapMode wrap)
{
    if (name.empty())
    {
        return std::nullopt;
    }
    const std::optional<std::filesystem::path> file = findBeside(m_path, named_in, name);
    const auto [image, is_new] = m_images.try_emplace(file.value_or(""));
    try
    {
        if (!file)
        {
            throw imageError(name, kNotBeside);
        }
        if (is_new)
        {
            const std::vector<std::uint8_t> encoded = readFile(*file);
            m_scene.images.push_back(
                m_decoding == ImageDecoding::WhenLoaded
                    ? decodeImage(encoded, name, name, m_image_bytes_left)
                    : deferImage(encoded, {*file, 0, encoded.size()}, name, name, m_path, m_image_bytes_left));
            m_image_bytes_left -= m_scene.images.back().rgba.size();
            image->second = static_cast<std::uint32_t>(m_scene.images.size() - 1);
        }
    }
    catch (const Error& failure)
    {
        warn(fmt::format("texture left out: {}", failure.what()));
    }
    if (!image->second)
    {
        return std::nullopt;
    }
    m_scene.textures.push_back({*image->second, wrap, wrap});
    return static_cast<std::uint32_t>(m_scene.textures.size() - 1);
}

Scene MeshScene::finish()
{
    if (std::ranges::all_of(m_scene.primitives, [](const Primitive& primitive) { return primitive.triangles.empty(); }))
    {
        std::ranges::for_each(m_scene.primitives, makePoints);
    }
    SceneSize size{.instance_count = static_cast<double>(m_scene.primitives.size())};
    for (const Primitive& primitive : m_scene.primitives)
    {
        size.triangle_count += static_cast<double>(primitive.triangles.size());
        size.vertex_count = std::max(size.vertex_count, static_cast<double>(primitive.positions.size()));
    }
    checkSceneSize(m_path, size);
    if (size.triangle_count == 0)
    {
        warn("without faces and points; only these become voxels");
    }
    return std::move(m_scene);
}

} // namespace zvo
