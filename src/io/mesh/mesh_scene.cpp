// SPDX-License-Identifier: MIT
#include "io/mesh/mesh_scene.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"
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

std::string withSlashes(std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

} // namespace

std::optional<std::filesystem::path> findBeside(const std::filesystem::path& mesh,
                                                const std::filesystem::path& named_in, std::string name)
{
    name = withSlashes(std::move(name));
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

bool leavesFolder(const std::filesystem::path& mesh, std::string name)
{
    return !liesBelow(folderOf(mesh), folderOf(mesh) / withSlashes(std::move(name)));
}

void MeshScene::warn(const std::string& what)
{
    const std::string line = inputError(m_path, what).what();
    if (std::find(m_scene.warnings.begin(), m_scene.warnings.end(), line) == m_scene.warnings.end())
    {
        m_scene.warnings.push_back(line);
    }
}

std::uint32_t MeshScene::add(Material material)
{
    m_scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(m_scene.materials.size() - 1);
}

std::optional<std::uint32_t> MeshScene::addTexture(const std::string& name, const std::filesystem::path& named_in,
                                                   WrapMode wrap)
{
    const std::optional<std::uint32_t> image = addImage(name, named_in);
    if (!image)
    {
        return std::nullopt;
    }
    m_scene.textures.push_back({*image, wrap, wrap});
    return static_cast<std::uint32_t>(m_scene.textures.size() - 1);
}

std::optional<std::uint32_t> MeshScene::addImage(const std::string& name, const std::filesystem::path& named_in)
{
    const std::optional<std::filesystem::path> file = findBeside(m_path, named_in, name);
    if (!file)
    {
        warn(fmt::format("texture left out: {}: {}", name,
                         leavesFolder(m_path, name) ? "it leaves the file's folder; only files in it and below are "
                                                      "read; put it there and name it"
                                                    : "there is no such file; put it there, or name another"));
        return std::nullopt;
    }
    const auto [known, is_new] = m_images.emplace(*file, std::nullopt);
    if (!is_new)
    {
        return known->second;
    }
    try
    {
        const std::vector<std::uint8_t> encoded = readFile(*file);
        m_scene.images.push_back(
            m_decoding == ImageDecoding::WhenLoaded
                ? decodeImage(encoded, name, name, m_image_bytes_left)
                : deferImage(encoded, {*file, 0, encoded.size()}, name, name, m_path, m_image_bytes_left));
        m_image_bytes_left -= m_scene.images.back().rgba.size();
        known->second = static_cast<std::uint32_t>(m_scene.images.size() - 1);
    }
    catch (const Error& failure)
    {
        warn(fmt::format("texture left out: {}", failure.what()));
    }
    return known->second;
}

Scene MeshScene::finish(std::vector<Primitive> primitives)
{
    SceneSize size{.instance_count = static_cast<double>(primitives.size())};
    for (const Primitive& primitive : primitives)
    {
        size.triangle_count += static_cast<double>(primitive.triangles.size());
        size.vertex_count = std::max(size.vertex_count, static_cast<double>(primitive.positions.size()));
        m_scene.instances.push_back({.primitive = static_cast<std::uint32_t>(m_scene.instances.size())});
    }
    checkSceneSize(m_path, size);
    m_scene.primitives = std::move(primitives);
    return std::move(m_scene);
}

} // namespace zvo
